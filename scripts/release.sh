#!/bin/bash
# Makes build/gale-VERSION.tar.gz of what is committed: a release, which builds without git. Says its checksum,
# and writes it to recipes for Spack and conda in build/.
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
require conda/recipe.yaml "^  version: \"${version//./\\.}\"$"
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

# The recipe as Spack's own repository takes it: its header and imports, and this version in place of a checkout.
mkdir -p build/spack
python3 - "$version" "$(sha256sum "$tarball" | cut -d' ' -f1)" <<'END' >build/spack/package.py
import re
import sys

version, checksum = sys.argv[1:]
text = open("spack/spack_repo/gale/packages/gale/package.py").read()


def replace(pattern, by):
    global text
    text, count = re.subn(pattern, by, text, flags=re.MULTILINE | re.DOTALL)
    assert count == 1, pattern


replace(r"\A# SPDX[^\n]*\n", "# Copyright Spack Project Developers. See COPYRIGHT file for details.\n#\n"
                             "# SPDX-License-Identifier: (Apache-2.0 OR MIT)\n")
replace(r"from spack.package import \([^)]*\)", "from spack.package import *")
replace(r"^CHECKOUT = [^\n]*\n\n\n", "\n")
replace(r"^    # To be filled in[^\n]*\n(    homepage[^\n]*\n).*?    license\(",
        rf'\1    url = "https://example.org/gale/gale-{version}.tar.gz"\n\n'
        '    # FIXME: homepage, url, and maintainers("...")\n\n    license(')
replace(r'^    version\("main"[^\n]*\n', f'    version("{version}", sha256="{checksum}")\n')
print(text, end="")
END
mkdir -p build/conda
sed "s/^  sha256: \"0*\"$/  sha256: \"$(sha256sum "$tarball" | cut -d' ' -f1)\"/" conda/recipe.yaml >build/conda/recipe.yaml
python3 -c 'compile(open("build/spack/package.py").read(), "package.py", "exec")'
echo "made build/spack/package.py and build/conda/recipe.yaml"
