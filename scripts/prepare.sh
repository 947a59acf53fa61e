# Sourced by ./sward and ./test: installs missing packages and configures the release build.
# Messages go to stderr; stdout belongs to the program.

sward_say() { printf '%s\n' "$*" >&2; }

sward_install_packages() {
  local stamp=build/.packages list=third_party/packages.txt packages missing=() package sudo=()
  if [ -f "$stamp" ] && cmp -s "$list" "$stamp"; then return 0; fi
  packages=$(grep -v '^#' "$list")
  for package in $packages; do
    dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  if [ ${#missing[@]} -gt 0 ]; then
    if [ "$(id -u)" -ne 0 ]; then
      command -v sudo >/dev/null || { sward_say "sward: these packages are missing, and neither root nor sudo is at hand: ${missing[*]}"; return 1; }
      sudo=(sudo)
    fi
    sward_say "sward: installing ${#missing[@]} Debian packages: ${missing[*]}"
    local log; log=$(mktemp)
    if ! { "${sudo[@]}" apt-get update && "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1 </dev/null; then
      tail -n 20 "$log" >&2
      sward_say "sward: installing failed; the lines above say why. Install the packages of third_party/packages.txt by hand, then try again."
      rm -f "$log"
      return 1
    fi
    rm -f "$log"
  fi
  mkdir -p build && cp "$list" "$stamp"
}

# sward_build TESTS(ON|OFF) TARGET...: brings the release build up to date; quiet unless there is something to do.
sward_build() {
  local tests=$1; shift
  mkdir -p build
  exec 9>build/.lock
  flock 9
  if [ ! -f build/release/build.ninja ] || { [ "$tests" = ON ] && ! grep -q 'SWARD_TESTS:BOOL=ON' build/release/CMakeCache.txt; }; then
    sward_say "sward: configuring"
    cmake --preset release -DSWARD_TESTS="$tests" >build/configure.log 2>&1 || { cat build/configure.log >&2; return 1; }
  fi
  [ -f build/release/.built-"$tests" ] || sward_say "sward: building; the first time takes some minutes"
  if ! ninja -C build/release "$@" >build/build.log 2>&1; then
    tail -n 60 build/build.log >&2
    sward_say "sward: the build failed; build/build.log has the whole log"
    return 1
  fi
  touch build/release/.built-"$tests"
  flock -u 9
  exec 9>&-
}
