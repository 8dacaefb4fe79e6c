#!/bin/bash
# Makes build/gale-VERSION.tar.gz of what is committed: a release, which builds without git. Says its checksum.
# With --check, only whether all places that name the version name the same.
#   usage: scripts/release.sh [--check]
set -euo pipefail
cd "$(dirname "$0")/.."
version=$(sed -n 's/^project(gale VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
[ -n "$version" ] || { echo "CMakeLists.txt has no version" >&2; exit 1; }

# What can't ask CMakeLists.txt.
require() { # FILE REGEX
  grep -Eq "$2" "$1" || { echo "$1 doesn't name the version $version: no line is $2" >&2; exit 1; }
}
require CITATION.cff "^version: ${version//./\\.}$"
require CHANGELOG.md "^## ${version//./\\.}, (2[0-9]{3}-[01][0-9]-[0-3][0-9]|not yet released)$"
require debian/changelog "^gale \\(${version//./\\.}-[0-9]+\\) "
require debian/control "^Package: libgale${version%.*}$"
[ "${1:-}" != --check ] || exit 0
[ $# = 0 ] || { echo "usage: $0 [--check]" >&2; exit 2; }

[ -z "$(git status --porcelain)" ] || { echo "there are changes that aren't committed" >&2; exit 1; }
require CHANGELOG.md "^## ${version//./\\.}, 2"
mkdir -p build
tarball=build/gale-$version.tar.gz
# No name and no time of compressing: the same commit gives the same bytes.
git archive --format=tar --prefix="gale-$version/" HEAD | gzip --no-name --best >"$tarball"
listed=$(tar -xOf "$tarball" "gale-$version/cmake/commit.txt")
[ "$listed" = "$(git rev-parse HEAD)" ] || { echo "$tarball says that its commit is $listed" >&2; exit 1; }
echo "made $tarball of $listed"
sha256sum "$tarball"
