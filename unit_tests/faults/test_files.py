"""Each call that writes, syncs, renames or closes fails once in a small run of each command, for want of space or by a
damaged disk; or it fails with all that follow it.

Samples, unless GALE_ALL_FAULTS is set.
"""
import errno
import unittest

import check


class Files(check.FaultTest):
    def test_no_space_once(self):
        self.try_all("file", 23, error=errno.ENOSPC)

    def test_no_space_any_more(self):
        self.try_all("file", 29, error=errno.ENOSPC, more=10**9)

    def test_a_damaged_disk(self):
        self.try_all("file", 31, error=errno.EIO)


if __name__ == "__main__":
    unittest.main()
