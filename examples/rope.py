# A rope from Python by ctypes, in ten lines: python3 rope.py   (for NumPy, plots and films: docs/how/python.md)
import ctypes, ctypes.util, sys

sinew = ctypes.CDLL(sys.argv[1] if len(sys.argv) > 1 else ctypes.util.find_library("sinew"))
scene = b'{"sinew": 1, "world": {"gravity": [0, -9.81]}, "figures": [{"prefab": "rope", "length": 2, "segments": 20, "weight": 5}]}'
rope, end = ctypes.c_uint32(), ctypes.c_uint64()
state = (ctypes.c_double * 10).from_buffer(bytearray(b"\x50" + bytes(79)))  # a struct begins with its size, here 80
if sinew.sinew_world_open(scene, None, ctypes.byref(rope)): sys.exit("no such scene")
sinew.sinew_world_find_particle(rope, b"rope/end", ctypes.byref(end))
sinew.sinew_world_step(rope, 600)
sinew.sinew_world_get_particle(rope, end, ctypes.byref(state))
print(f"the weight hangs at ({state[1]:.3f}, {state[2]:.3f})")
