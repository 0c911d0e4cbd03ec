# shellcheck shell=bash
# Sourced by run, test and bench: builds a preset, with a line of progress every few seconds.

# one cache for all clones of the repository
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true

# build_preset PRESET [-DNAME=VALUE ...] -- [TARGET ...]
build_preset() {
  local preset=$1 definitions=()
  shift
  while [[ $# -gt 0 && $1 != -- ]]; do
    definitions+=("$1")
    shift
  done
  [[ $# -eq 0 ]] || shift
  local folder=build/$preset log
  log=$(mktemp)
  if [[ ! -f $folder/build.ninja || ${#definitions[@]} -gt 0 ]]; then
    if ! cmake --preset "$preset" "${definitions[@]}" >"$log" 2>&1; then
      tail -n 30 "$log" >&2
      rm -f "$log"
      echo "build: cmake --preset $preset failed" >&2
      return 1
    fi
  fi
  NINJA_STATUS='[%f/%t] ' ninja -C "$folder" "$@" >"$log" 2>&1 &
  local ninja=$! begin=$SECONDS status=0 next_line=3
  # a script's background job does not hear Ctrl-C itself
  # shellcheck disable=SC2064
  trap "kill $ninja 2>/dev/null || true; rm -f '$log'; exit 130" INT TERM
  while kill -0 "$ninja" 2>/dev/null; do
    sleep 0.2
    if ((SECONDS - begin >= next_line)); then
      echo "build: $preset $(grep -o '^\[[0-9]*/[0-9]*\]' "$log" | tail -n 1 || true) after $((SECONDS - begin)) s"
      next_line=$((SECONDS - begin + 10))
    fi
  done
  wait "$ninja" || status=$?
  trap - INT TERM
  if [[ $status -ne 0 ]]; then
    grep -v '^\[[0-9]*/[0-9]*\] ' "$log" | tail -n 60 >&2
    echo "build: preset $preset failed" >&2
  fi
  rm -f "$log"
  return "$status"
}
