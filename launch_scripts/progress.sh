# shellcheck shell=bash
# Sourced by the other scripts: a line of progress every few seconds for whatever takes long.

# with_progress TEXT LOG COMMAND ...: appends what the command says to LOG, and prints TEXT with the newest line of it
# every few seconds. Returns the command's status; Ctrl-C ends the command too.
with_progress() {
  local text=$1 log=$2 first_line_s=3 period_s=8
  shift 2
  local begin=$SECONDS next=$first_line_s status=0 job
  set -m # a process group of its own, so that it ends with all its children
  "$@" </dev/null >>"$log" 2>&1 &
  job=$!
  set +m
  # shellcheck disable=SC2064
  trap "kill -- -$job 2>/dev/null || true; exit 130" INT TERM
  while kill -0 "$job" 2>/dev/null; do
    sleep 0.2
    if ((SECONDS - begin >= next)); then
      echo "$text, $((SECONDS - begin)) s: $(grep . "$log" | tail -n 1 | cut -c 1-90 || true)"
      next=$((SECONDS - begin + period_s))
    fi
  done
  wait "$job" || status=$?
  trap - INT TERM
  return "$status"
}
