#pragma once

/// Everything a program needs to build bodies and step a world. Scene files and pictures: sinew/session/session.h.
#include "sinew/assert/assert.h"
#include "sinew/prefab/prefabs.h"
#include "sinew/prefab/steer.h"
#include "sinew/prefab/walk.h"
#include "sinew/simulation.h"
#include "sinew/world/edit.h"
#include "sinew/world/environment.h"
#include "sinew/world/measure.h"
