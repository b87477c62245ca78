#include <gtest/gtest.h>

#include "tests/apps/program.h"

namespace interflect::test {
namespace {

const std::string scene_text = R"({ "format": "interflect/scene/1", "units": "m",
  "materials": { "lamp": { "reflectance": 0, "exitance": 1 } },
  "geometry": [
    { "file": "m.obj", "unmapped": "mtl" },
    { "polygon": [[0,0,1],[0,1,1],[1,1,1],[1,0,1]], "material": "lamp" } ],
  "cameras": [ { "eye": [0.5, 0.5, 0.9], "target": [0.5, 0.6, 0], "size": [64, 64] } ] })";

/// A floor under a lamp, whose MTL file says this.
std::string floor_of(const TemporaryFolder& folder, const std::string& mtl) {
  folder.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl a\nf 1 2 3 4\n");
  folder.write("m.mtl", "newmtl a\n" + mtl);
  return folder.write("s.json", scene_text);
}

TEST(MtlMaterials, are_part_of_what_a_picture_goes_on_from) {
  const TemporaryFolder folder;
  const auto trace = [&](const std::string& scene, std::vector<std::string> more) {
    more.insert(more.begin(), {"trace", scene, "--spp", "100000", "--max-time", "0.3s", "-o", folder / "p.exr"});
    return interflect(more);
  };
  const std::string scene = floor_of(folder, "Kd 0.5\n");
  ASSERT_EQ(trace(scene, {}).status, 1);  // stopped
  EXPECT_EQ(trace(scene, {"--resume"}).status, 1);
  for (const char* other : {"Kd 0.6\n", "Kd 0.5\nd 0.5\n", "Ks 0.5\nillum 3\n", "Ks 0.6\nillum 3\n",
                            "Ks 0.5\nillum 5\n", "Ni 1.5\nillum 7\n"}) {
    floor_of(folder, other);
    const Outcome refused = trace(scene, {"--resume"});
    EXPECT_EQ(refused.status, 2) << other;
    EXPECT_TRUE(contains(refused.err, "this checkpoint is of another scene")) << refused.err;
  }
}

TEST(MtlMaterials, that_radiosity_does_not_know_are_refused_by_name) {
  const TemporaryFolder folder;
  const Outcome net = interflect({"solve", floor_of(folder, "Kd 0.5\nd 0.5\n"), "-o", folder / "net"});
  EXPECT_EQ(net.status, 2);
  EXPECT_TRUE(contains(net.err, "'a' is not all there")) << net.err;
  const Outcome mirror = interflect({"solve", floor_of(folder, "Ks 0.9 0.9 0.9\nillum 3\n"), "-o", folder / "mirror"});
  EXPECT_EQ(mirror.status, 0) << mirror.err;
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--bounds"}, {"--residual"}, {"--order", "1"}, {"--goal", "camera:camera-1"}}) {
    std::vector<std::string> words{"solve", folder / "s.json", "-o", folder / "refused"};
    words.insert(words.end(), option.begin(), option.end());
    const Outcome refused = interflect(words);
    EXPECT_EQ(refused.status, 2) << option[0];
    EXPECT_TRUE(contains(refused.err, "a mirror or glass: it does not go with")) << refused.err;
  }
}

}  // namespace
}  // namespace interflect::test
