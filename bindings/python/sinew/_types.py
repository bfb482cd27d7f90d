"""Types of arrays."""

from typing import Any

import numpy as np
import numpy.typing as npt

#: float32 or float64, as the precision of the scene is
Reals = npt.NDArray[Any]
Ids = npt.NDArray[np.uint64]
Indices = npt.NDArray[np.uint32]
Bools = npt.NDArray[np.bool_]
