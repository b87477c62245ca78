#include "visual/film_heaps.h"

#include <algorithm>
#include <limits>

#include "scene/film_map.h"

namespace interflect::visual {
namespace {

using Rectangle = Eigen::AlignedBox2d;

Rectangle rectangle_of(const Polygons& body, const scene::FilmMap& film, const Vec3& eye) {
  Rectangle rectangle;
  for (const Vec3& p : body.corners)
    if (const auto at = film.film_of({eye, (p - eye).normalized()})) {
      rectangle.extend(*at);
    } else {
      const Vec2 everywhere = Vec2::Constant(std::numeric_limits<double>::infinity());
      return {-everywhere, everywhere};
    }
  return rectangle;
}

}  // namespace

std::vector<std::vector<std::size_t>> film_heaps(std::span<const Polygons> bodies, const scene::Camera& camera,
                                                 std::size_t most) {
  const scene::FilmMap film(camera);
  std::vector<Rectangle> rectangles;
  for (const Polygons& body : bodies) rectangles.push_back(rectangle_of(body, film, camera.eye));
  std::vector<std::vector<std::size_t>> heaps;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const auto free = [&](const std::vector<std::size_t>& heap) {
      return std::ranges::none_of(heap, [&](std::size_t other) { return rectangles[k].intersects(rectangles[other]); });
    };
    const auto place = std::ranges::find_if(heaps, free);
    if (place != heaps.end())
      place->push_back(k);
    else if (heaps.size() < most)
      heaps.push_back({k});
    else
      heaps.back().push_back(k);
  }
  return heaps;
}

}  // namespace interflect::visual
