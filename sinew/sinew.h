#pragma once

/// All that a program needs to make things and let them move. Scene files and pictures: sinew/session/session.h.
#include "sinew/prefab/prefabs.h"
#include "sinew/solver/edit.h"
#include "sinew/solver/measure.h"
#include "sinew/solver/step.h"
