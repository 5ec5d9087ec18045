# SPDX-License-Identifier: Apache-2.0
"""Whether the faults that scripts/plant_faults.py plants still fit the sources."""
import importlib.util
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
SPEC = importlib.util.spec_from_file_location("plant_faults", ROOT / "scripts" / "plant_faults.py")
plant_faults = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(plant_faults)


class PlantedFaults(unittest.TestCase):
    """Every fault's text stands in its file exactly once."""

    def test_texts_stand_in_the_sources_once(self):
        self.assertEqual([], plant_faults.misplaced(ROOT))

    def test_there_are_many_of_different_names(self):
        names = {fault.name for fault in plant_faults.FAULTS}
        self.assertEqual(len(names), len(plant_faults.FAULTS))
        self.assertGreaterEqual(len(names), 20)

    def test_texts_that_are_gone_are_told(self):
        with tempfile.TemporaryDirectory() as folder:
            found = plant_faults.misplaced(Path(folder))
        self.assertEqual(len(plant_faults.FAULTS), len(found))


if __name__ == "__main__":
    unittest.main()
