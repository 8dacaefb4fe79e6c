#!/bin/bash
# Builds the documentation site in build/docs: index.html. Warnings are errors.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/dependencies.sh docs
site=$PWD/build/docs environment=$PWD/build/docs-environment
mkdir -p "$site"
if [ ! -x "$environment/bin/sphinx-build" ]; then
  python3 -m venv "$environment"
  "$environment/bin/pip" install --quiet furo myst-parser numpy sphinx sphinxcontrib-mermaid
fi
"$environment/bin/sphinx-build" -W --keep-going -q -b html -d build/docs-doctrees docs "$site"

headers=$(cmake "-DPROJECT_SOURCE_DIR=$PWD" -P docs/headers.cmake)
{ cat docs/Doxyfile; echo "INPUT = $headers"; echo "OUTPUT_DIRECTORY = $site"; echo "HTML_OUTPUT = cpp"; } | doxygen -
echo "built $site/index.html"
