#pragma once

#include "tests/support/direct_light.h"

namespace interflect::fem::test {

using interflect::test::direct_light;
using interflect::test::DirectLight;

}  // namespace interflect::fem::test
