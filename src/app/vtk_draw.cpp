#include <dlfcn.h>

#include <cmath>

#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageResize.h>
#include <vtkLegendBoxActor.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkTextProperty.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <gale/base/error.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/detail/vtk_messages.hpp>

#include "scene.hpp"

VTK_MODULE_INIT(vtkRenderingOpenGL2)
VTK_MODULE_INIT(vtkRenderingFreeType)

namespace gale::app {

namespace {

constexpr int width = 1200, height = 800;

vtkSmartPointer<vtkPoints> to_vtk(const std::vector<Point>& points) {
  auto all = vtkSmartPointer<vtkPoints>::New();
  for (const Point& point : points) all->InsertNextPoint(point.data());
  return all;
}

void set_color(vtkActor* actor, const Color& color) { actor->GetProperty()->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0); }

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
  vtkNew<vtkWindowedSincPolyDataFilter> smooth;  // voxels have steps
  smooth->SetInputData(data);
  smooth->SetNumberOfIterations(15);
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
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.18);
  actor->GetProperty()->SetDiffuse(0.85);
  actor->GetProperty()->SetSpecular(0.08);
  actor->GetProperty()->SetSpecularPower(20);
  renderer->AddActor(actor);
}

void add_tubes(vtkRenderer* renderer, const Scene::Tubes& tubes) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  for (const auto& path : tubes.paths) {
    lines->InsertNextCell(static_cast<int>(path.size()));
    for (const Point& point : path) lines->InsertCellPoint(points->InsertNextPoint(point.data()));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(data);
  tube->SetRadius(tubes.radius);
  tube->SetNumberOfSides(8);
  tube->CappingOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(tube->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  set_color(actor, tubes.color);
  actor->GetProperty()->SetAmbient(0.3);
  actor->GetProperty()->SetSpecular(0.2);
  renderer->AddActor(actor);
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
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  set_color(actor, balls.color);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.8);
  actor->GetProperty()->SetSpecular(0.35);
  actor->GetProperty()->SetSpecularPower(30);
  renderer->AddActor(actor);
}

void add_legend(vtkRenderer* renderer, const std::vector<Scene::Balls>& balls) {
  vtkNew<vtkRegularPolygonSource> disc;
  disc->SetNumberOfSides(32);
  disc->Update();
  vtkNew<vtkLegendBoxActor> legend;
  legend->SetNumberOfEntries(static_cast<int>(balls.size()));
  for (std::size_t i = 0; i < balls.size(); ++i) {
    double color[3] = {balls[i].color[0] / 255.0, balls[i].color[1] / 255.0, balls[i].color[2] / 255.0};
    legend->SetEntry(static_cast<int>(i), disc->GetOutput(), balls[i].caption.c_str(), color);
  }
  legend->GetEntryTextProperty()->SetColor(0.1, 0.1, 0.1);
  legend->BorderOff();
  legend->SetPosition(0.79, 0.38);
  legend->SetPosition2(0.19, 0.21);
  renderer->AddActor(legend);
}

/// From the high corner, everything on the left of the legend.
void aim(vtkRenderer* renderer, const Scene& scene) {
  double centre[3], size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    centre[axis] = (scene.low[axis] + scene.high[axis]) / 2;
    size += (scene.high[axis] - scene.low[axis]) * (scene.high[axis] - scene.low[axis]);
  }
  size = std::sqrt(size);
  vtkCamera* const camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(centre);
  camera->SetPosition(centre[0] + 1.1 * size, centre[1] + 0.9 * size, centre[2] + 0.85 * size);
  camera->SetViewUp(0, 0, 1);
  camera->SetViewAngle(29);
  camera->SetWindowCenter(0.2, 0);
  renderer->ResetCameraClippingRange();
}

vtkSmartPointer<vtkRenderWindow> make_window() {
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(2 * width, 2 * height);  // twice as large as the picture, for smooth outlines
  return window;
}

}  // namespace

void require_drawing() {
  const auto window = make_window();
  if (!window->IsA("vtkXOpenGLRenderWindow")) return;
  // This kind of window ends the process if there is no display. It brought the library that can tell.
  const auto open = reinterpret_cast<void* (*)(const char*)>(dlsym(RTLD_DEFAULT, "XOpenDisplay"));
  const auto close = reinterpret_cast<int (*)(void*)>(dlsym(RTLD_DEFAULT, "XCloseDisplay"));
  if (open == nullptr || close == nullptr) return;
  void* const display = open(nullptr);
  if (display == nullptr) throw Error("there is no X display, which VTK needs to draw (--render): start gale with xvfb-run");
  close(display);
}

void draw(const std::string& path, const Scene& scene) {
  try {
    const io::detail::VtkMessages messages("VTK gave up");
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1, 1, 1);
    add_skin(renderer, scene.skin);
    for (const auto& tubes : scene.tubes) add_tubes(renderer, tubes);
    for (const auto& balls : scene.balls) add_balls(renderer, balls, scene.ball_radius);
    add_legend(renderer, scene.balls);
    aim(renderer, scene);
    const auto window = make_window();
    window->AddRenderer(renderer);
    window->Render();
    vtkNew<vtkWindowToImageFilter> picture;
    picture->SetInput(window);
    picture->ReadFrontBufferOff();
    vtkNew<vtkImageResize> half;
    half->SetInputConnection(picture->GetOutputPort());
    half->SetOutputDimensions(width, height, 1);
    io::AtomicFile file(path);
    vtkNew<vtkPNGWriter> writer;
    writer->SetFileName(file.temporary().c_str());
    writer->SetCompressionLevel(9);
    writer->SetInputConnection(half->GetOutputPort());
    writer->Write();
    messages.check(writer->GetErrorCode());
    file.commit();
  } catch (const std::exception& error) {
    throw Error("cannot draw '" + path + "': " + error.what());
  }
}

}  // namespace gale::app
