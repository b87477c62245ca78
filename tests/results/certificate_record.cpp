#include "results/certificate_record.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

using namespace interflect;
using nlohmann::json;

TEST(CertificateRecord, says_what_was_judged_and_how_it_came_out) {
  scene::Scene scene;
  scene.channels = {"r", "g", "b"};
  for (int c = 0; c < 3; ++c) scene.weights[c] = 1.0 / 3;
  scene.expected = {{"desk", scene::Expected::Statistic::mean, 300, 0.01, "a book"}};
  std::vector<validation::Judged> judged(3);
  for (std::size_t i = 0; i < 3; ++i) {
    validation::Judged& j = judged[i];
    j.name = "wall \"" + std::to_string(i) + "\"";
    j.area = 2;
    j.fem = {Spectrum(i == 2 ? 130.0 : 101.0), Spectrum::zero(), Spectrum(2), Claim::estimated, 0};
    j.mc = unbiased_estimate(Spectrum(100), Spectrum(1), 100);
  }
  validation::EnergyBalance fem;
  fem.on_backs = Spectrum(0.25);
  fem.residual = Spectrum(1e-9);
  const auto certificate = validation::certify(scene, judged, fem, {}, {});
  const json back = json::parse(json_text(results::certificate_record(certificate, judged, scene.channels)));
  EXPECT_EQ(back["passed"], false);
  EXPECT_EQ(back["verdict"], certificate.verdict);
  EXPECT_EQ(back["judgements"].size(), 4u);
  const json& weighted = back["judgements"][0];
  EXPECT_EQ(weighted["reading"], "illuminance");
  EXPECT_EQ(weighted["disagreeing"].size(), 1u);
  EXPECT_EQ(weighted["disagreeing"][0]["name"], "wall \"2\"");
  EXPECT_NEAR(weighted["disagreeing"][0]["fem"].get<double>(), 130, 1e-9);
  EXPECT_TRUE(weighted["surfaces"]["all"]["l2"]["high"].is_number());
  EXPECT_FALSE(weighted["elements"]["all"].contains("l2"));
  EXPECT_NEAR(weighted["surfaces"]["all"]["bias"]["value"].get<double>(), 32.0 / 300, 1e-12);
  EXPECT_LT(weighted["surfaces"]["all"]["bias"]["low"].get<double>(), 32.0 / 300);
  EXPECT_EQ(back["worst_surface"]["name"], "wall \"2\"");
  EXPECT_EQ(back["measurements"].size(), 3u);
  EXPECT_EQ(back["measurements"][0]["fem"]["value"], json({101.0, 101.0, 101.0}));
  EXPECT_EQ(back["energy"]["fem"]["on_backs"], json({0.25, 0.25, 0.25}));
  EXPECT_TRUE(back["energy"]["fem"].contains("residual"));
  EXPECT_FALSE(back["energy"]["path_traced"].contains("on_backs"));  // not known: not written
  EXPECT_FALSE(back["energy"]["path_traced"].contains("residual"));
  EXPECT_EQ(back["expected"][0]["passed"], false);
  EXPECT_TRUE(back["expected"][0]["fem"].is_null());  // there is no such sensor
  EXPECT_EQ(back["not_finite"][0], "/expected/0/fem: nan");
}
