#include "apps/goals.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "apps/table.h"
#include "core/error.h"
#include "core/format.h"
#include "fem/point_of_view.h"

namespace interflect::apps {
namespace {

constexpr const char* camera_prefix = "camera:";

fem::Goal::AtPoints at_points(std::span<const measure::SensorPoint> points, const std::string& sensor) {
  fem::Goal::AtPoints goal;
  for (const measure::SensorPoint& point : points)
    if (sensor.empty() || point.sensor == sensor) goal.points.push_back(point.at);
  return goal;
}

std::string names_known(const scene::Scene& scene) {
  std::string known;
  for (const scene::Sensor& sensor : scene.sensors) known += sensor.name + ", ";
  for (const scene::Camera& camera : scene.cameras) known += camera_prefix + camera.name + ", ";
  return known + "or the name of a surface";
}

/// A number as it is told, with an error that holds of what is told.
struct Told {
  std::string value;
  double error;
};
/// In five digits, or in as many as its error is worth: rounding is to be a small part of that.
Told told(double value, double error) {
  constexpr int fewest = 5, most = 12;
  const double ratio = std::abs(value) / error;  // not finite where one of them is 0 or unknown
  const int worth = std::isfinite(ratio) && ratio > 1 ? static_cast<int>(std::ceil(std::log10(ratio))) + 2 : fewest;
  std::string text = core::format("%.*g", std::clamp(worth, fewest, most), value);
  const double rounding = std::abs(std::strtod(text.c_str(), nullptr) - value);
  return {std::move(text), error + rounding};
}

/// "0.26 %" of a positive value; "-" of others.
std::string part_text(double error, double value) {
  return value > 0 ? core::format("%.2g %%", core::rounded_up(100 * error / value, 2)) : "-";
}

}  // namespace

fem::Goal goal_named(const std::string& name, const scene::Scene& scene, std::span<const measure::SensorPoint> points) {
  if (name.empty() && points.empty())
    throw core::InputError("--goal", "the scene has no sensor: " + names_known(scene) + " expected");
  if (fem::Goal::AtPoints goal = at_points(points, name); !goal.points.empty())
    return {name.empty() ? "sensors" : name, std::move(goal)};
  if (name.rfind(camera_prefix, 0) == 0)
    if (const auto camera = scene.find_camera(name.substr(std::string(camera_prefix).size()))) {
      fem::require_point_of_view(scene.camera(*camera));
      return {name, fem::Goal::InView{*camera}};
    }
  for (const scene::SurfaceId id : scene.surface_ids())
    for (const scene::Side side : {scene::Side::front, scene::Side::back})
      if (scene.material(id).active(side) && scene.side_name(id, side) == name)
        return {name, fem::Goal::OnSurface{id, side}};
  throw core::InputError("--goal " + name, "one of " + names_known(scene) + " expected");
}

GoalQuantity quantity_of(const fem::Goal& goal, const scene::Scene& scene) {
  const bool pixels = std::holds_alternative<fem::Goal::InView>(goal.what);
  return {(pixels ? "L_avg(" : "E_avg(") + goal.name + ")", pixels ? scene.radiance_unit() : scene.irradiance_unit()};
}

std::string goal_line(const std::string& quantity, double value, double error, const char* unit,
                      std::optional<double> proved) {
  const auto [text, bound] = told(value, proved.value_or(error));
  const std::string part = value > 0 ? part_text(bound, value) + ", " : "";
  const std::string claim = proved ? core::format("guaranteed; estimated %.2g", error) : "estimated";
  return core::format("%s = %s %s, error <= %.2g %s (%s%s)", quantity.c_str(), text.c_str(), unit,
                      core::rounded_up(bound, 2), unit, part.c_str(), claim.c_str());
}

std::string adaptation_text(const fem::Adaptation& adaptation, const scene::Scene& scene) {
  const auto [quantity, unit] = quantity_of(adaptation.goal, scene);
  Table table({"pass", "elements", "unknowns", quantity, "error", "relative", "time"});
  for (std::size_t k = 0; k < adaptation.passes.size(); ++k) {
    const fem::AdaptivePass& pass = adaptation.passes[k];
    const double value = scene.weigh(pass.value);
    const auto [text, error] = told(value, scene.weigh(pass.error));
    table.add({std::to_string(k + 1), core::format("%td", pass.elements), core::format("%td", pass.unknowns), text,
               core::format("%.2g", core::rounded_up(error, 2)), part_text(error, value),
               core::format_duration(pass.seconds)});
  }
  const fem::AdaptivePass& last = adaptation.passes.back();
  return table.text() + "stopped     " + describe(adaptation.why) + "\n" +
         goal_line(quantity, scene.weigh(last.value), scene.weigh(last.error), unit) + "\n";
}

results::Record adaptation_record(const fem::Adaptation& adaptation, const scene::Scene& scene) {
  results::Record::List passes;
  for (const fem::AdaptivePass& pass : adaptation.passes)
    passes.push_back(results::Record()
                         .add("elements", static_cast<std::int64_t>(pass.elements))
                         .add("unknowns", static_cast<std::int64_t>(pass.unknowns))
                         .add("value", scene.weigh(pass.value))
                         .add("error", scene.weigh(pass.error))
                         .add("claim", "estimated")
                         .add("relative_error", pass.relative)
                         .add("seconds", pass.seconds));
  results::Record record;
  return record.add("goal", adaptation.goal.name)
      .add("stopped", describe(adaptation.why))
      .add("met", adaptation.why == fem::AdaptiveStop::met)
      .add("passes", std::move(passes));
}

}  // namespace interflect::apps
