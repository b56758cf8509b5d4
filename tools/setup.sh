# Sourced by ./run and ./test: packages and build.  Says what it does on standard error.

say() { echo "$*" >&2; }

fail() { say "$0: $*"; exit 1; }

# The packages of packages.txt that $1 ("run", or "test" for all) needs and that are not installed.
missing_packages() {
  awk -v who="$1" '$1 !~ /^#/ && NF && ($2 == "run" || who == "test") { print $1 }' packages.txt | while read -r package; do
    [ "$package" = npm ] && command -v npm >/dev/null && continue  # Node.js from elsewhere brings its own
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q ' installed$' || echo "$package"
  done
}

# "sudo" where it is needed and there.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

install_packages() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || {
    say "This is no Debian machine: the packages of packages.txt are taken to be there."
    return
  }
  local missing
  missing=$(missing_packages "$1" | tr '\n' ' ')
  [ -n "$missing" ] || return 0
  say "Installing $missing(a few minutes)"
  local by_hand="please install them first: apt-get install $missing"
  [ "$(id -u)" -eq 0 ] || command -v sudo >/dev/null || fail "neither root nor sudo, so packages can't be installed; $by_hand"
  as_root apt-get -qq update >/dev/null || fail "apt-get update failed; $by_hand"
  # shellcheck disable=SC2086
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends $missing >/dev/null || fail "apt-get install failed; $by_hand"
}

# What tests/studio drives the browser with, into build/npm, where it isn't there yet.
install_npm_packages() {
  local lock=tests/studio/package-lock.json here=build/npm
  cmp -s "$lock" "$here/installed.json" && return
  say "Installing the npm packages of tests/studio"
  mkdir -p "$here"
  cp tests/studio/package.json "$lock" "$here"
  npm ci --prefix "$here" --ignore-scripts --no-audit --no-fund --loglevel=error >&2 ||
    fail "npm could not fetch what tests/studio needs ($(npm config get registry) must be reachable), so the studio can't be tested"
  cp "$lock" "$here/installed.json"
}

# configure TESTS (ON or OFF): build/ stays as it is where nothing changed.
configure() {
  cmake -S . -B build -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING="$1" >&2 || fail "cmake failed"
}

# build [TARGET]...
build() {
  local targets=()
  [ $# -eq 0 ] || targets=(--target "$@")
  cmake --build build --parallel "$(nproc)" "${targets[@]}" >&2 || fail "the build failed"
}
