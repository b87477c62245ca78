#pragma once

#include "scene/scene.h"  // solvers know nothing of scenes: the test of the house's rules must object
