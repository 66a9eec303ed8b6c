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
  apt-get update -q >/dev/null
  # shellcheck disable=SC2086
  DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing >/dev/null
}
