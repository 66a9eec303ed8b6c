# Sourced by tests/run.sh and examples/quickstart.sh: need_packages NAME... installs what Debian lacks.
# As root it uses apt-get, with an update only when something is missing; others are told what to ask for.
need_packages() {
  missing=
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  if [ "$(id -u)" -ne 0 ]; then
    echo "These Debian packages are missing, and only root can install them:$missing" >&2
    echo "  apt-get install --no-install-recommends$missing" >&2
    exit 2
  fi
  echo "installing$missing"
  # Another apt may be at work: wait for its locks. `update` does not wait for the lock of its lists by itself.
  tries=0
  until log=$(apt-get update -q 2>&1); do
    tries=$((tries + 1))
    case $log in *"Could not get lock"*) [ $tries -lt 120 ] && sleep 5 && continue ;; esac
    echo "$log" >&2
    exit 2
  done
  # shellcheck disable=SC2086
  DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 install -q -y --no-install-recommends \
    $missing >/dev/null
}
