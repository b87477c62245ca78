#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <limits>

#include "results/vtu.h"
#include "tests/support/temporary_folder.h"
#include "tiny.h"

using namespace interflect;

TEST(VtuThroughVtk, reads_back_what_was_written) {
  std::vector<scene::SurfacePatch> patches = tiny::Floor::elements(5, Vec3(0.1, 1.0 / 3, 1e-9));
  const Vec3 a(0, 0, 1), b(1, 0, 1), c(0, 1.0 / 7, 1);
  patches.push_back(make_patch(scene::SurfaceId{1}, scene::Side::back, std::array{a, b, c}));
  const mesh::ElementMesh mesh(patches);
  const auto n = static_cast<std::size_t>(mesh.size());
  std::vector<Spectrum> values(n);
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) values[i][k] = std::sin(static_cast<double>(3 * i) + k) * 1e-7;
  std::vector<double> error(n, 1.0 / 3);
  error[7] = std::numeric_limits<double>::infinity();
  std::vector<results::CellField> fields = results::id_fields(mesh);
  fields.push_back(results::spectrum_field("irradiance", values, {"r", "g", "b"}));
  fields.push_back(results::scalar_field("error <&>", error));
  const test::TemporaryFolder scratch;
  const std::filesystem::path file = scratch / "field.vtu";
  results::write_vtu(file, mesh, fields);

  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfCells(), static_cast<vtkIdType>(n));
  EXPECT_EQ(grid->GetNumberOfPoints(), 36 + 3);
  vtkCellData* data = grid->GetCellData();
  ASSERT_EQ(data->GetNumberOfArrays(), 5);
  vtkDataArray* irradiance = data->GetArray("irradiance");
  ASSERT_NE(irradiance, nullptr);
  ASSERT_EQ(irradiance->GetNumberOfComponents(), 3);
  EXPECT_STREQ(irradiance->GetComponentName(1), "g");
  for (std::size_t i = 0; i < n; ++i) {
    const auto id = static_cast<vtkIdType>(i);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(irradiance->GetComponent(id, k), values[i][k]);
    EXPECT_EQ(data->GetArray("error <&>")->GetComponent(id, 0), error[i]);
    EXPECT_EQ(data->GetArray("element")->GetComponent(id, 0), static_cast<double>(i));
    EXPECT_EQ(data->GetArray("surface")->GetComponent(id, 0), i == 25 ? 1 : 0);
    EXPECT_EQ(data->GetArray("side")->GetComponent(id, 0), i == 25 ? 1 : 0);
    vtkCell* cell = grid->GetCell(id);
    ASSERT_EQ(cell->GetNumberOfPoints(), patches[i].corners);
    for (int k = 0; k < patches[i].corners; ++k) {
      double p[3];
      grid->GetPoint(cell->GetPointId(k), p);
      EXPECT_EQ(Vec3(p[0], p[1], p[2]), patches[i].corner[static_cast<std::size_t>(k)]);
    }
  }
}
