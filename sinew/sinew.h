#pragma once

/// Everything a program needs to build bodies and step a world. Scene files and pictures: sinew/session/session.h.
#include "sinew/assert/assert.h"
#include "sinew/prefab/prefabs.h"
#include "sinew/simulation.h"
#include "sinew/solver/edit.h"
#include "sinew/solver/environment.h"
#include "sinew/solver/measure.h"
