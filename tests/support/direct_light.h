#pragma once

#include <array>

#include "core/vec.h"

namespace interflect::test {

/// What a point of the floor sees of a square source, half a metre to either side, that faces it two metres up, alone
/// and past a square blocker of the same size one metre up, on the same axis: docs/truths.md 2.9.
struct DirectLight {
  Vec3 x;  ///< [m]
  double open, blocked;
};

inline const std::array<DirectLight, 12> direct_light{{{{0, 0, 0}, .073477634813, 0},
                                                       {{.5, 0, 0}, .066182613783, 0},
                                                       {{.6, 0, 0}, .063289108275, .007557182366},
                                                       {{.75, 0, 0}, .058406458357, .017821902089},
                                                       {{1, 0, 0}, .049521835726, .029443796377},
                                                       {{1.25, 0, 0}, .040681704379, .033623897844},
                                                       {{1.5, 0, 0}, .032663265537, .032663265537},
                                                       {{2, 0, 0}, .020278199912, .020278199912},
                                                       {{1, 1, 0}, .035321277345, .029028221206},
                                                       {{.75, .75, 0}, .047358289438, .024093099852},
                                                       {{1.25, .25, 0}, .039846191745, .032909077393},
                                                       {{1.4, 1.4, 0}, .020704801802, .020596516308}}};

}  // namespace interflect::test
