"""check_test_names.py: what it must find, and what it must leave alone."""

import unittest

import check_test_names

GOOD = [
    "Korobov.RefusesADegenerateLattice",
    "EveryLobe/ForwardAndBackward.AgreeWithEverySamplerAndSource/phong_reflected",
    "Cells/Packets.MeetWhatSingleRaysMeet/3",
]


class CheckTestNames(unittest.TestCase):
    def test_names_that_are_words_are_good(self):
        self.assertEqual(check_test_names.faults(GOOD), [])

    def test_raw_memory_is_found(self):
        bad = "EveryLobe/ForwardAndBackward.Agree/112-byte object <50-99 4C-3B 55-00>"
        self.assertEqual(len(check_test_names.faults([*GOOD, bad])), 1)

    def test_addresses_are_found(self):
        self.assertEqual(len(check_test_names.faults([*GOOD, "All/Samplers.Are/0x55d01c2a7f10"])), 1)

    def test_two_tests_of_one_name_are_found(self):
        self.assertEqual(len(check_test_names.faults([*GOOD, GOOD[0]])), 1)

    def test_a_folder_without_tests_is_a_fault(self):
        self.assertEqual(len(check_test_names.faults([])), 1)


if __name__ == "__main__":
    unittest.main()
