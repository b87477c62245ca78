#pragma once

#include <algorithm>
#include <cmath>

#include "montecarlo/film/reconstruction_filter.h"

namespace interflect::montecarlo {

/// visit(x, y, h) of all pixels of the picture that count a point of the film, h = filter(point - middle) != 0.
template <class Visit>
void spread(const Vec2& film, int width, int height, const ReconstructionFilter& filter, const Visit& visit) {
  const double reach = filter.reach();
  const auto first = [&](double at) { return static_cast<int>(std::ceil(std::max(at - 0.5 - reach, 0.0))); };
  const auto last = [&](double at, int size) {
    return static_cast<int>(std::floor(std::min(at - 0.5 + reach, size - 1.0)));
  };
  if (!(film.x() > -reach && film.y() > -reach && film.x() < width + reach && film.y() < height + reach)) return;
  for (int y = first(film.y()); y <= last(film.y(), height); ++y)
    for (int x = first(film.x()); x <= last(film.x(), width); ++x)
      if (const double h = filter.value(film - Vec2(x + 0.5, y + 0.5)); h != 0) visit(x, y, h);
}

}  // namespace interflect::montecarlo
