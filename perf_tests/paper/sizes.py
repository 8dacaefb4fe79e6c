"""The sizes of the experiments: meshes, runs and what is varied."""

# Six meshes of the paper's numbers of tetrahedra, of different character; the last is the one that the paper looks at
# closest. `small` bears two cores for ten minutes, `device` a machine with a device for some minutes (an eighth of the
# paper's), `smallest` is for tests.
PAPER = {"Engine": "smooth:108", "Foot": "noisy:142", "Fish": "ball:196", "Asteroid": "shells:318", "Hole": "dense:209",
         "Stent": "grid:256"}
SMALL = {"Engine": "smooth:28", "Foot": "noisy:36", "Fish": "ball:48", "Asteroid": "shells:76", "Hole": "dense:52",
         "Stent": "grid:64"}
DEVICE = {"Engine": "smooth:54", "Foot": "noisy:71", "Fish": "ball:98", "Asteroid": "shells:159", "Hole": "dense:105",
          "Stent": "grid:128"}
SMALLEST = {"Engine": "smooth:8", "Stent": "grid:10"}
SIZES = {
    "smallest": {"meshes": SMALLEST, "runs": 1, "consumers": [1, 2], "values": 2, "studied": ["Stent"]},
    "small": {"meshes": SMALL, "runs": 5, "consumers": [1, 2, 4, 8, 16, 40], "values": 99, "studied": ["Engine", "Stent"]},
    "device": {"meshes": DEVICE, "runs": 3, "consumers": [1, 4, 16, 40], "values": 99, "studied": ["Stent"]},
    "paper": {"meshes": PAPER, "runs": 5, "consumers": [1, 8, 16, 24, 32, 40], "values": 99, "studied": list(PAPER)},
}
