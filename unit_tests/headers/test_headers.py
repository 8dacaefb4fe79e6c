"""The lists of cmake/gale-headers.cmake against the sources:
usage test_headers.py SOURCE_DIR --public HEADER... --included HEADER... --generated HEADER..."""
import argparse
import re
import sys
import unittest
from pathlib import Path

parser = argparse.ArgumentParser()
parser.add_argument("source", type=Path)
for name in ("--public", "--included", "--generated"):
    parser.add_argument(name, nargs="*", default=[])
lists = parser.parse_args()


def included_by(header):
    """The headers of ours that a header includes, as their paths in the source tree."""
    if header in lists.generated:
        return set()
    return set(re.findall(r"^\s*#\s*include\s*<gale/([^>]+)>", (lists.source / header).read_text(), re.M))


def reached_from(headers):
    """These, and all that they include, directly or not."""
    reached, waiting = set(), set(headers)
    while waiting:
        reached |= waiting
        waiting = set().union(*map(included_by, waiting)) - reached
    return reached


class Headers(unittest.TestCase):
    def test_each_is_named_once(self):
        named = lists.public + lists.included + lists.generated
        self.assertEqual(sorted(named), sorted(set(named)))

    def test_installed_headers_include_installed_headers_only(self):
        missing = reached_from(lists.public) - set(lists.public + lists.included + lists.generated)
        self.assertEqual(sorted(missing), [], "to be named in gale_included_headers")

    def test_no_header_is_installed_for_nothing(self):
        superfluous = set(lists.included) - reached_from(lists.public)
        self.assertEqual(sorted(superfluous), [], "no public header includes them")

    def test_public_headers_include_with_angle_brackets(self):
        quoted = [header for header in lists.public + lists.included
                  if re.search(r'^\s*#\s*include\s*"', (lists.source / header).read_text(), re.M)]
        self.assertEqual(quoted, [], "installed headers are found below <gale/...> alone")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
