#!/bin/bash
# Builds the documentation site in build/docs: index.html. Warnings are errors.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/dependencies.sh docs
python3 docs/pictures/check.py
site=$PWD/build/docs environment=$PWD/build/docs-environment
mkdir -p "$site"
if [ ! -x "$environment/bin/sphinx-build" ]; then
  python3 -m venv "$environment"
  "$environment/bin/pip" install --quiet furo myst-parser numpy sphinx sphinxcontrib-mermaid
fi
"$environment/bin/sphinx-build" -W --keep-going -q -b html -d build/docs-doctrees docs "$site"

# The headers as programs include them. What they declare without a comment is an error, and so is a header that the list
# in docs/reference.dox leaves out.
mkdir -p build/docs-include
ln -sfn "$PWD/src" build/docs-include/gale
mapfile -t headers < <(cmake "-DPROJECT_SOURCE_DIR=$PWD" -P docs/headers.cmake)
for header in "${headers[@]}"; do
  grep -qx "/\*\* .file $header" docs/reference.dox || { echo "docs/reference.dox doesn't list $header" >&2; exit 1; }
done

# Comments begin with a verb or with the noun that they document: blocks in all sources, what stands behind code in these headers.
refuse_beginnings() { # PATTERN FILE...
  awk -v pattern="$1" '{ line = tolower($0); if (within && line ~ /^ *\/\/\/? /) next; within = line ~ /^ *\/\/\/? / }
    line ~ pattern "(of|they|those|none|it|the same|likewise|so many)([^a-z]|$)" {
      print FILENAME ":" FNR ": a comment begins with a verb or with the noun that it documents: " $0; found = 1
    } END { exit found }' "${@:2}" >&2
}
mapfile -t sources < <(find src baselines bindings unit_tests perf_tests examples -name '*.cpp' -o -name '*.h' -o -name '*.hpp')
refuse_beginnings '^ *///? ' "${sources[@]}"
refuse_beginnings '///< ' "${headers[@]/#gale/src}"

# Files that these pages name are there; x and X stand for a name.
files=$(find ./src ./baselines ./bindings ./cmake ./docs ./unit_tests -type f)
for name in $(grep -ohE '[A-Za-z0-9_/-]+\.(cpp|hpp|h|py|xml|cmake|txt|md)\b' docs/architecture.md docs/extending.md | grep -vE '(^|[/e])[xX][./]'); do
  grep -q "/$name\$" <<<"$files" || { echo "docs name $name, which isn't there" >&2; exit 1; }
done
options=$(cat docs/Doxyfile && printf '%s\n' "INPUT = $PWD/docs/reference.dox ${headers[*]}" "OUTPUT_DIRECTORY = $site" "HTML_OUTPUT = cpp")
cd build/docs-include # what \ref says of folders is relative to it
doxygen - <<<"$options"
echo "built $site/index.html"
