"""Each allocation fails once, or with all that follow it, in a small run of each command; each thread doesn't start.

Samples, unless GALE_ALL_FAULTS is set.
"""
import unittest

import check


class Allocations(check.FaultTest):
    def test_one_fails(self):
        self.try_all("allocation", 149)

    def test_all_fail_from_one_on(self):
        self.try_all("allocation", 223, more=10**9)

    def test_a_thread_does_not_start(self):
        self.try_all("thread", 1)


if __name__ == "__main__":
    unittest.main()
