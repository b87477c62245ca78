#include "results/colour_map.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace interflect::results {

namespace {

constexpr Colour plasma[] = {{13, 8, 135},   {76, 2, 161},   {126, 3, 168},  {170, 35, 149}, {204, 71, 120},
                             {230, 108, 92}, {248, 149, 64}, {253, 197, 39}, {240, 249, 33}};
constexpr Colour viridis[] = {{68, 1, 84},    {71, 45, 123}, {59, 82, 139},  {44, 114, 142}, {33, 145, 140},
                              {40, 174, 128}, {94, 201, 98}, {173, 220, 48}, {253, 231, 37}};
constexpr Colour inferno[] = {{0, 0, 4},     {33, 12, 74},  {87, 16, 110},  {138, 34, 106}, {188, 55, 84},
                              {228, 90, 49}, {249, 142, 9}, {249, 203, 53}, {252, 255, 164}};
constexpr Colour blue_white_red[] = {{33, 60, 160},   {68, 112, 208},  {130, 171, 234},
                                     {196, 217, 244}, {247, 247, 247}, {247, 208, 190},
                                     {234, 146, 120}, {204, 76, 66},   {152, 12, 40}};

std::span<const Colour> points_of(ColourMap map) {
  switch (map) {
    case ColourMap::plasma:
      return plasma;
    case ColourMap::viridis:
      return viridis;
    case ColourMap::inferno:
      return inferno;
    case ColourMap::blue_white_red:
      return blue_white_red;
  }
  return plasma;
}

}  // namespace

Colour colour_of(ColourMap map, double t) {
  if (std::isnan(t)) return no_data;
  const std::span<const Colour> points = points_of(map);
  const double at = std::clamp(t, 0.0, 1.0) * static_cast<double>(points.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), points.size() - 2);
  const double part = at - static_cast<double>(below);
  Colour out;
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = static_cast<std::uint8_t>(std::lround((1 - part) * points[below][c] + part * points[below + 1][c]));
  return out;
}

}  // namespace interflect::results
