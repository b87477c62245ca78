#include "scene/finish.h"

#include "core/fresnel.h"

namespace interflect::scene {

std::string type_of(const Finish& finish) {
  static constexpr const char* names[] = {"diffuse", "mirror", "metal", "dielectric", "glass", "plastic"};
  static_assert(std::size(names) == std::variant_size_v<Finish>);
  return names[finish.index()];
}

double most_transmitted(double index) { return core::Pane{index, 1}(1).transmitted; }

}  // namespace interflect::scene
