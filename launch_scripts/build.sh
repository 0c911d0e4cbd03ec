# shellcheck shell=bash
# Sourced by run, test, lint and bench: builds a preset, with a line of progress every few seconds.

# shellcheck source=launch_scripts/progress.sh
source "$(dirname "${BASH_SOURCE[0]}")/progress.sh"

# one cache for all clones of the repository
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true

# build_preset PRESET [TARGET ...]: without targets, those of the build preset. One at a time in a build folder.
build_preset() {
  local preset=$1 waiting_s=8 begin=$SECONDS status=0 lock
  if ! { mkdir -p build && touch "build/$preset.lock"; } 2>/dev/null; then
    echo "build: $PWD/build cannot be written by $(id -un): clone the repository for yourself, or set OMENTUM_BIN to" \
      "the folder of the built programs and OMENTUM_CACHE to a folder of yours" >&2
    return 2
  fi
  exec {lock}>>"build/$preset.lock"
  until flock --wait "$((SECONDS > begin ? waiting_s : 1))" "$lock"; do
    echo "build: waiting for process $(cat "build/$preset.lock"), which builds $preset too, $((SECONDS - begin)) s"
  done
  echo $$ >"build/$preset.lock"
  configure_and_build "$@" || status=$?
  exec {lock}>&- # the session that follows must not hold it
  return "$status"
}

configure_and_build() {
  local preset=$1 log status=0
  local targets=("${@:2}")
  # a folder that is built from nothing is built whole; to work in, there is the preset dev
  [[ -e build/$preset/CMakeCache.txt ]] || export OMENTUM_UNITY=ON
  log=$(mktemp)
  if ! with_progress "build: configuring $preset" "$log" cmake --preset "$preset"; then
    tail -n 30 "$log" >&2
    echo "build: cmake --preset $preset failed" >&2
    status=1
  elif : >"$log" && ! with_progress "build: $preset" "$log" \
    cmake --build --preset "$preset" ${targets[0]+--target "${targets[@]}"}; then
    grep -v '^\[[0-9]*/[0-9]*\] ' "$log" | tail -n 60 >&2
    echo "build: preset $preset failed" >&2
    status=1
  fi
  rm -f "$log"
  return "$status"
}
