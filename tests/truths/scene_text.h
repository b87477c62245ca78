#pragma once

#include <Eigen/Geometry>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "core/format.h"
#include "scene/reader.h"

namespace interflect::test {

/// Where a scene is put, and how large it is made: x -> rotation (scale x) + shift.  Irradiance does not notice.
struct Placement {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 shift = Vec3::Zero();
  Vec3 operator()(const Vec3& x) const { return rotation * (scale * x) + shift; }
};

/// A scene file, written as a user would.
class SceneText {
 public:
  explicit SceneText(std::vector<std::string> channels, Placement placement = {})
      : channels_(std::move(channels)), place_(std::move(placement)) {}

  /// One number a channel.
  void material(const std::string& name, std::span<const double> reflectance, std::span<const double> exitance) {
    add(materials_, "\"" + name + "\": { \"type\": \"diffuse\", \"sides\": \"front\", \"reflectance\": " +
                        list(reflectance) + ", \"exitance\": " + list(exitance) + " }");
  }
  void material(const std::string& name, std::initializer_list<double> reflectance,
                std::initializer_list<double> exitance) {
    material(name, std::span(reflectance.begin(), reflectance.size()), std::span(exitance.begin(), exitance.size()));
  }
  void polygon(const std::string& name, const std::string& material, std::span<const Vec3> ring) {
    std::string corners;
    for (const Vec3& x : ring) {
      const Vec3 p = place_(x);
      add(corners, core::format("[%.17g, %.17g, %.17g]", p.x(), p.y(), p.z()));
    }
    add(geometry_,
        "{ \"name\": \"" + name + "\", \"material\": \"" + material + "\", \"polygon\": [" + corners + "] }");
  }
  void polygon(const std::string& name, const std::string& material, std::initializer_list<Vec3> ring) {
    polygon(name, material, std::span(ring.begin(), ring.size()));
  }
  /// The walls of a room over a counter-clockwise ring of the xy plane, seen from inside: NAME/floor, NAME/ceiling,
  /// NAME/wall.
  void prism_room(const std::string& name, const std::string& material, std::span<const Vec3> floor, double height) {
    const Vec3 up(0, 0, height);
    std::vector<Vec3> top;
    for (auto x = floor.rbegin(); x != floor.rend(); ++x) top.push_back(*x + up);
    polygon(name + "/floor", material, floor);
    polygon(name + "/ceiling", material, top);
    for (std::size_t i = 0; i < floor.size(); ++i) {
      const Vec3 &a = floor[i], &b = floor[(i + 1) % floor.size()];
      polygon(name + "/wall", material, {b, a, a + up, b + up});
    }
  }
  /// Six faces NAME/x-, NAME/x+, .. NAME/z+, seen from outside.
  void block(const std::string& name, const std::string& material, const Vec3& low, const Vec3& high) {
    for (int axis = 0; axis < 3; ++axis)
      for (const bool far : {false, true}) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<Vec3, 4> ring;
        for (std::size_t k = 0; k < 4; ++k) {
          ring[k][axis] = far ? high[axis] : low[axis];
          ring[k][u] = k == 1 || k == 2 ? high[u] : low[u];
          ring[k][v] = k >= 2 ? high[v] : low[v];
        }
        if (!far) std::swap(ring[1], ring[3]);
        polygon(name + "/" + std::string(1, "xyz"[axis]) + (far ? "+" : "-"), material, ring);
      }
  }
  /// Any entry of the list of geometry.
  void entry(const std::string& json) { add(geometry_, json); }

  /// Read as a file is, with what it refers to in `folder`.
  scene::Scene read(const std::filesystem::path& folder = ".") const {
    std::string names;
    for (const std::string& channel : channels_) add(names, "\"" + channel + "\"");
    return scene::parse_scene(
        "{ \"format\": \"interflect/scene/1\", \"units\": \"m\", \"quantity\": \"radiometric\", \"channels\": [" +
            names + "], \"weights\": " + list(std::vector<double>(channels_.size(), 1.0)) + ",\n\"materials\": {" +
            materials_ + "},\n\"geometry\": [" + geometry_ + "] }",
        "truth.json", folder);
  }

 private:
  static void add(std::string& list, const std::string& item) { list += (list.empty() ? "" : ",\n") + item; }
  static std::string list(std::span<const double> numbers) {
    std::string text;
    for (double number : numbers) add(text, core::format("%.17g", number));
    return "[" + text + "]";
  }

  std::vector<std::string> channels_;
  Placement place_;
  std::string materials_, geometry_;
};

}  // namespace interflect::test
