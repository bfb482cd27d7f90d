#pragma once

/// Everything a program needs to build bodies and step a world. Scene files and pictures: sinew/session/session.h.
#include "sinew/assert.h"
#include "sinew/prefab/prefabs.h"
#include "sinew/solver/edit.h"
#include "sinew/solver/measure.h"
#include "sinew/solver/step.h"
