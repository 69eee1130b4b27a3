#include "libtracker/body/polygonise.h"

#include <cmath>
#include <utility>

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace depthmocap {
namespace {

struct Grid {
  int half_x, ny, nz;
  Eigen::Vector3d lower;
};

Grid gridAround(const BodyField& field, double cell) {
  // Two cells of margin, so that the surface never meets the border of the grid.
  const Eigen::Vector3d lower = field.lower().cast<double>();
  const Eigen::Vector3d upper = field.upper().cast<double>();
  const auto cells = [&](double length) { return static_cast<int>(std::ceil(length / cell)) + 4; };
  const int half_x = cells(upper.x());
  return {half_x, cells(upper.y() - lower.y()) + 1, cells(upper.z() - lower.z()) + 1,
          Eigen::Vector3d(-half_x * cell, lower.y() - 2.0 * cell, lower.z() - 2.0 * cell)};
}

void sample(const BodyField& field, double cell, const Grid& grid, vtkFloatArray& values) {
  const int nx = 2 * grid.half_x + 1;
  vtkIdType row = 0;
  for (int k = 0; k < grid.nz; ++k) {
    for (int j = 0; j < grid.ny; ++j, row += nx) {
      for (int i = 0; i <= grid.half_x; ++i) {
        const Eigen::Vector3d p(i * cell, grid.lower.y() + j * cell, grid.lower.z() + k * cell);
        float value = field.distance(p.cast<float>());
        if (std::abs(value) < 1e-6F) value = 1e-6F;  // an edge cut exactly at its end makes empty triangles
        values.SetValue(row + grid.half_x + i, value);
        values.SetValue(row + grid.half_x - i, value);
      }
    }
  }
}

}  // namespace

void polygonise(const BodyField& field, double cell, BodySurface& surface) {
  const Grid grid = gridAround(field, cell);
  vtkNew<vtkImageData> image;
  image->SetDimensions(2 * grid.half_x + 1, grid.ny, grid.nz);
  image->SetSpacing(cell, cell, cell);
  image->SetOrigin(grid.lower.x(), grid.lower.y(), grid.lower.z());
  image->AllocateScalars(VTK_FLOAT, 1);
  sample(field, cell, grid, *vtkFloatArray::SafeDownCast(image->GetPointData()->GetScalars()));

  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();

  vtkPolyData* mesh = contour->GetOutput();
  surface.vertices.resize(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i) {
    double p[3];
    mesh->GetPoint(i, p);
    surface.vertices[static_cast<std::size_t>(i)] = Eigen::Vector3d(p[0], p[1], p[2]).cast<float>();
  }
  surface.triangles.clear();
  vtkCellArray* cells = mesh->GetPolys();
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  for (cells->InitTraversal(); cells->GetNextCell(count, ids) != 0;) {
    surface.triangles.push_back(
        {static_cast<std::uint32_t>(ids[0]), static_cast<std::uint32_t>(ids[1]), static_cast<std::uint32_t>(ids[2])});
  }
  if (enclosedVolume(surface.vertices, surface.triangles) < 0) {
    for (auto& t : surface.triangles) std::swap(t[1], t[2]);
  }
}

}  // namespace depthmocap
