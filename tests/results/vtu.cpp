#include "results/vtu.h"

#include <gtest/gtest.h>

#include <stack>

#include "core/error.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/vtu_values.h"
#include "tiny_mesh.h"

using namespace interflect;
using namespace interflect::results;
using test::values;

namespace {

/// Every opened element is closed, in order; returns the number of elements, or -1.
int well_formed(const std::string& xml) {
  std::stack<std::string> open;
  int count = 0;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return -1;
    const std::string tag = xml.substr(at + 1, end - at - 1);
    at = end;
    if (tag[0] == '?') continue;
    if (tag[0] == '/') {
      if (open.empty() || open.top() != tag.substr(1)) return -1;
      open.pop();
      continue;
    }
    ++count;
    if (tag.back() != '/') open.push(tag.substr(0, tag.find(' ')));
  }
  return open.empty() ? count : -1;
}

}  // namespace

TEST(Vtu, base64_has_the_values_of_the_standard) {
  // RFC 4648, section 10.
  const std::pair<const char*, const char*> known[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : known) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64("\xff\xff\xfe"), "///+");
}

TEST(Vtu, is_well_formed_and_its_arrays_have_the_right_sizes) {
  const mesh::ElementMesh mesh = tiny::mesh();
  std::vector<CellField> fields = id_fields(mesh);
  Spectrum s;
  for (int c = 0; c < 3; ++c) s[c] = c + 0.5;
  fields.push_back(spectrum_field("irradiance <lx> & \"more\"", std::vector<Spectrum>(3, s), {"r", "g", "b"}));
  fields.push_back(scalar_field("error", {0.1, 0.2, 0.3}));
  const std::string xml = vtu_text(mesh, fields);
  EXPECT_EQ(well_formed(xml), 6 + 4 + 5);  // elements of the frame, of the grid, of the data
  EXPECT_NE(xml.find("NumberOfPoints=\"9\" NumberOfCells=\"3\""), std::string::npos);  // six shared corners and three
  EXPECT_EQ(values<double>(xml, "Points").size(), 27u);
  EXPECT_EQ(values<std::int64_t>(xml, "offsets"), (std::vector<std::int64_t>{4, 8, 11}));
  EXPECT_EQ(values<std::int64_t>(xml, "connectivity"), (std::vector<std::int64_t>{0, 1, 2, 3, 1, 4, 5, 2, 6, 7, 8}));
  EXPECT_EQ(values<std::uint8_t>(xml, "types"), (std::vector<std::uint8_t>{9, 9, 5}));
  EXPECT_EQ(values<double>(xml, "error"), (std::vector<double>{0.1, 0.2, 0.3}));
  EXPECT_EQ(values<std::int64_t>(xml, "element"), (std::vector<std::int64_t>{0, 1, 2}));
  EXPECT_EQ(values<std::int32_t>(xml, "surface"), (std::vector<std::int32_t>{0, 0, 1}));
  EXPECT_EQ(values<std::int32_t>(xml, "side"), (std::vector<std::int32_t>{0, 0, 1}));
  EXPECT_EQ(values<double>(xml, "irradiance &lt;lx&gt; &amp; &quot;more&quot;").size(), 9u);
  EXPECT_NE(xml.find("ComponentName2=\"b\""), std::string::npos);
}

TEST(Vtu, a_field_that_does_not_fit_the_mesh_is_refused) {
  EXPECT_THROW(vtu_text(tiny::mesh(), std::vector{scalar_field("error", {1, 2})}), core::PreconditionError);
}

// Mirrors and glass are there, and nothing is known of them.
TEST(Vtu, has_what_has_no_elements_behind_them_without_values) {
  const std::vector bare{
      make_patch(scene::SurfaceId{2}, scene::Side::back, std::array{Vec3(0, 0, 5), Vec3(1, 0, 5), Vec3(0, 1, 5)})};
  std::vector<CellField> fields = id_fields(tiny::mesh(), bare);
  fields.push_back(scalar_field("error", {0.1, 0.2, 0.3}));
  const std::string xml = vtu_text(tiny::mesh(), fields, bare);
  EXPECT_NE(xml.find("NumberOfPoints=\"12\" NumberOfCells=\"4\""), std::string::npos);
  EXPECT_EQ(values<std::uint8_t>(xml, "types"), (std::vector<std::uint8_t>{9, 9, 5, 5}));
  EXPECT_EQ(values<std::int64_t>(xml, "element"), (std::vector<std::int64_t>{0, 1, 2, -1}));
  EXPECT_EQ(values<std::int32_t>(xml, "surface"), (std::vector<std::int32_t>{0, 0, 1, 2}));
  EXPECT_EQ(values<std::int32_t>(xml, "side"), (std::vector<std::int32_t>{0, 0, 1, 1}));
  const std::vector<double> error = values<double>(xml, "error");
  ASSERT_EQ(error.size(), 4u);
  EXPECT_EQ(error[2], 0.3);
  EXPECT_TRUE(std::isnan(error[3]));
  EXPECT_THROW(vtu_text(tiny::mesh(), std::vector{scalar_field("error", {1, 2})}, bare), core::PreconditionError);
}

// Two quads and a triangle are 4 + 4 + 3 quadratic triangles, with values at points.
TEST(Vtu, of_a_smooth_mesh_has_quadratic_triangles_and_values_at_points) {
  const mesh::SmoothMesh smooth = mesh::smooth_mesh(tiny::mesh());
  std::vector<double> heights;
  for (const Vec3& p : smooth.points) heights.push_back(p.z());
  const CellField field = scalar_field("height", heights);
  const std::string xml = vtu_text(smooth, {&field, 1});
  EXPECT_EQ(well_formed(xml), 7 + 4 + 2);  // elements of the frame, of the grid, of the data
  EXPECT_EQ(values<std::uint8_t>(xml, "types"), std::vector<std::uint8_t>(11, 22));
  EXPECT_EQ(values<std::int64_t>(xml, "connectivity").size(), 66u);
  EXPECT_EQ(values<double>(xml, "height"), heights);
  EXPECT_EQ(values<std::int64_t>(xml, "element"), (std::vector<std::int64_t>{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2}));
}
