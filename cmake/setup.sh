# SPDX-License-Identifier: BSD-3-Clause
# Shared by ./fly and ./check: the packages of Debian 12 and Ubuntu that Fulmar needs, and the build. Sourced, not run.

packages=(g++ cmake ninja-build ccache libeigen3-dev libboost-dev libyaml-cpp-dev libspdlog-dev libzstd-dev zlib1g-dev libssl-dev
          libgeographiclib-dev libfastrtps-dev libfastcdr-dev nlohmann-json3-dev libcli11-dev doctest-dev)

# Without these the plugin for Python and its module are left out.
python_packages=(python3 python3-dev pybind11-dev python3-numpy)

# The page of a running flight and components in Python need these; without them all other parts are built.
install_optional_packages() {
  command -v npm >/dev/null || ( install_missing nodejs npm ) || echo "No nodejs and npm: Fulmar is built without the page of a flight." >&2
  ( install_missing "${python_packages[@]}" ) || echo "Without ${python_packages[*]} Fulmar is built without components in Python." >&2
}

# Installs the missing ones of the named packages. Needs root or sudo only for an installation.
install_missing() {
  local missing=()
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  local sudo=""
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "These packages are missing and there is no sudo to install them: ${missing[*]}" >&2; exit 1; }
    sudo=sudo
  fi
  echo "Installing ${missing[*]}"
  $sudo apt-get update -qq
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

install_packages() {
  command -v apt-get >/dev/null || { echo "No apt-get here: install ${packages[*]} by hand." >&2; return 0; }
  install_missing "${packages[@]}"
  install_optional_packages
}

# configure_and_build FOLDER [cmake option...] -- [ninja target...]
configure_and_build() {
  local folder=$1 options=() targets=()
  shift
  while [ $# -gt 0 ] && [ "$1" != -- ]; do options+=("$1"); shift; done
  [ $# -gt 0 ] && shift
  targets=("$@")
  if [ ! -f "$folder/build.ninja" ] || [ ${#options[@]} -gt 0 ]; then
    mkdir -p "$folder"
    echo "Configuring $folder"
    cmake -S . -B "$folder" -G Ninja "${options[@]}" >"$folder/configure.log" 2>&1 || { cat "$folder/configure.log"; exit 1; }
  fi
  NINJA_STATUS="[%f/%t, %e s] " ninja -C "$folder" "${targets[@]}"
}

# Targets of the hourglass mission: the host and its plugins.
build_first() {
  configure_and_build build -- first_flight
}

# Parts that the build leaves out, each with its missing packages; empty for none.
left_out() { grep -hE 'is left out: |^-- No page of the flight: ' build/configure.log | sed 's/^-- //'; }

# All plugins and the programs for the ground, without tests. Configures again where packages were missing: they may be installed now.
build_rest() {
  if left_out >/dev/null; then cmake -S . -B build >build/configure.log 2>&1 || { cat build/configure.log; return 1; }; fi
  configure_and_build build -- flight tools || return
  left_out || true
}
