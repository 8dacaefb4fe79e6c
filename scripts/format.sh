#!/bin/bash
# Formats all C++ sources with clang-format 14 (Debian 12's), or says which ones aren't.
#   usage: scripts/format.sh [--check]
set -euo pipefail
cd "$(dirname "$0")/.."

case "${1:-}" in
  "" | --check) ;;
  *) echo "usage: $0 [--check]" >&2; exit 2 ;;
esac

clang_format=$(command -v clang-format-14 || command -v clang-format) ||
  { echo "$0: there is no clang-format; scripts/dependencies.sh format installs it" >&2; exit 1; }
"$clang_format" --version | grep --quiet 'version 14\.' ||
  { echo "$0: $("$clang_format" --version), but versions differ in what they make: take 14" >&2; exit 1; }

mapfile -d '' files < <(find . -path './.*' -prune -o -path './build*' -prune -o -path './install*' -prune -o \
  \( -name '*.cpp' -o -name '*.hpp' -o -name '*.h' \) -type f -print0 | sort --zero-terminated)
if [ -z "${1:-}" ]; then
  printf '%s\0' "${files[@]}" | xargs --null --max-procs="$(nproc)" --max-args=20 "$clang_format" -i
  exit
fi

unformatted=()
for file in "${files[@]}"; do
  "$clang_format" "$file" | cmp --quiet - "$file" || unformatted+=("$file")
done
[ ${#unformatted[@]} = 0 ] || { printf 'not formatted: %s\n' "${unformatted[@]}" >&2; exit 1; }
echo "${#files[@]} files are formatted"
