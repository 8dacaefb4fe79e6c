#include <dlfcn.h>

#include <cmath>
#include <stdexcept>

#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkSphereSource.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <gale/app/drawing/drawer.hpp>
#include <gale/app/drawing/module/png.hpp>
#include <gale/version.hpp>

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)

namespace gale::app {

namespace {

vtkSmartPointer<vtkPoints> to_vtk(const std::vector<Point>& points) {
  auto all = vtkSmartPointer<vtkPoints>::New();
  for (const Point& point : points) all->InsertNextPoint(point.data());
  return all;
}

void shade(vtkProperty* look, double ambient, double diffuse, double specular, double power) {
  look->SetAmbient(ambient);
  look->SetDiffuse(diffuse);
  look->SetSpecular(specular);
  look->SetSpecularPower(power);
}

void add_skin(vtkRenderer* renderer, const Scene::Skin& skin) {
  vtkNew<vtkPolyData> data;
  data->SetPoints(to_vtk(skin.points));
  vtkNew<vtkCellArray> triangles;
  for (const auto& triangle : skin.triangles) {
    const vtkIdType ids[3] = {triangle[0], triangle[1], triangle[2]};
    triangles->InsertNextCell(3, ids);
  }
  data->SetPolys(triangles);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (const Color& color : skin.colors) colors->InsertNextTypedTuple(color.data());
  data->GetPointData()->SetScalars(colors);
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;
  smooth->SetInputData(data);
  smooth->SetNumberOfIterations(skin.has_steps ? 15 : 0);
  smooth->SetPassBand(0.08);
  smooth->FeatureEdgeSmoothingOff();
  smooth->NonManifoldSmoothingOn();
  smooth->NormalizeCoordinatesOn();
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(smooth->GetOutputPort());
  normals->SetFeatureAngle(50);
  normals->SplittingOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  vtkProperty* const look = add_actor(renderer, mapper, {255, 255, 255});
  skin.has_steps ? shade(look, 0.38, 0.8, 0.08, 20) : shade(look, 0.3, 0.7, 0, 1);
}

void add_tubes(vtkRenderer* renderer, const Scene::Tubes& tubes) {
  const auto data =
      lines_along(tubes.paths, [](vtkPoints* to, const Point& point) { return to->InsertNextPoint(point.data()); });
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(data);
  tube->SetRadius(tubes.radius);
  tube->SetNumberOfSides(8);
  tube->CappingOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tube->GetOutputPort());
  mapper->ScalarVisibilityOff();
  shade(add_actor(renderer, mapper, tubes.color), 0.3, 1, 0.2, 1);
}

void add_balls(vtkRenderer* renderer, const Scene::Balls& balls, double radius) {
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(radius);
  ball->SetThetaResolution(20);
  ball->SetPhiResolution(14);
  vtkNew<vtkPolyData> data;
  data->SetPoints(to_vtk(balls.centres));
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceConnection(ball->GetOutputPort());
  shade(add_actor(renderer, mapper, balls.color), 0.25, 0.8, 0.35, 30);
}

/// Looks from the high corner, or along an axis along which the mesh has no extent, without perspective. The mesh is as
/// large as there is room for left of the legend.
void aim(vtkRenderer* renderer, const Scene& scene) {
  const double aspect = double(scene.legend.width) / scene.legend.height, left_part = scene.part_of_mesh, margin = 0.96;
  Point towards = {0.664, 0.544, 0.513}, right = {-0.634, 0.773, 0}, up = {-0.397, -0.325, 0.858};
  for (int axis = 0; axis < 3; ++axis) {
    if (scene.low[axis] < scene.high[axis]) continue;
    towards = right = up = {};
    towards[axis] = right[(axis + 1) % 3] = up[(axis + 2) % 3] = 1;
  }
  const auto along = [](const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (const Point& point : scene.skin.points) {
    for (int i = 0; i < 2; ++i) {
      const double place = along(point, i == 0 ? right : up);
      low[i] = std::min(low[i], place);
      high[i] = std::max(high[i], place);
    }
  }
  const double scale = std::max((high[0] - low[0]) / (left_part * aspect), high[1] - low[1]) / 2 /
                       margin;  // half of the picture's height
  const double x = (low[0] + high[0]) / 2 + (1 - left_part) * scale * aspect, y = (low[1] + high[1]) / 2;
  const double size =
      std::hypot(scene.high[0] - scene.low[0], scene.high[1] - scene.low[1], scene.high[2] - scene.low[2]);
  const Point middle = {(scene.low[0] + scene.high[0]) / 2, (scene.low[1] + scene.high[1]) / 2,
                        (scene.low[2] + scene.high[2]) / 2};
  double focus[3], position[3];
  for (int axis = 0; axis < 3; ++axis) {
    focus[axis] = x * right[axis] + y * up[axis] + along(middle, towards) * towards[axis];
    position[axis] = focus[axis] + 2 * size * towards[axis];
  }
  vtkCamera* const camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(focus);
  camera->SetPosition(position);
  camera->SetViewUp(up.data());
  camera->SetParallelScale(scale);
  renderer->ResetCameraClippingRange();
}

void require_display() {
  const auto window = make_window(100, 100);
  if (!window->IsA("vtkXOpenGLRenderWindow")) return;
  // This kind of window ends the process if there is no display. So ask first, through the X library that it loaded.
  const auto open = reinterpret_cast<void* (*)(const char*)>(dlsym(RTLD_DEFAULT, "XOpenDisplay"));
  const auto close = reinterpret_cast<int (*)(void*)>(dlsym(RTLD_DEFAULT, "XCloseDisplay"));
  if (open == nullptr || close == nullptr) return;
  void* const display = open(nullptr);
  if (display == nullptr)
    throw std::runtime_error("there is no X display, which VTK needs to draw (--render): start gale with xvfb-run");
  close(display);
}

void draw_scene(const std::string& file, const Scene& scene) {
  const Fill fill_scene = [&](vtkRenderer* renderer) {
    add_skin(renderer, scene.skin);
    for (const auto& tubes : scene.tubes) add_tubes(renderer, tubes);
    for (const auto& balls : scene.balls) add_balls(renderer, balls, scene.ball_radius);
    aim(renderer, scene);
  };
  const Fill fill_legend = [&](vtkRenderer* renderer) { fill(renderer, scene.legend); };
  write_png(file, scene.legend.width, scene.legend.height, {fill_scene, fill_legend});
}

}  // namespace
}  // namespace gale::app

const gale::app::Drawer* gale_drawer() {
  static constexpr gale::app::Drawer drawer = {
      gale::version,        sizeof(gale::app::Flat), sizeof(gale::app::Scene), gale::app::require_display,
      gale::app::draw_flat, gale::app::draw_scene};
  return &drawer;
}
