#include <cerrno>

#include <vtkCamera.h>
#include <vtkImageResize.h>
#include <vtkPNGWriter.h>
#include <vtkPolyDataMapper.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWindowToImageFilter.h>

#include <gale/app/drawing/module/png.hpp>
#include <gale/app/drawing/module/vtk_messages.hpp>

namespace gale::app {

vtkSmartPointer<vtkRenderWindow> make_window(int width, int height) {
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(finer * width, finer * height);
  return window;
}

void write_png(const std::string& file, int width, int height, const std::vector<Fill>& layers) {
  const VtkMessages messages;
  const auto window = make_window(width, height);
  window->SetNumberOfLayers(static_cast<int>(layers.size()));
  for (std::size_t i = 0; i < layers.size(); ++i) {
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1, 1, 1);
    renderer->SetLayer(static_cast<int>(i));
    layers[i](renderer);
    window->AddRenderer(renderer);
  }
  window->Render();
  vtkNew<vtkWindowToImageFilter> drawn;
  drawn->SetInput(window);
  drawn->ReadFrontBufferOff();
  vtkNew<vtkImageResize> picture;
  picture->SetInputConnection(drawn->GetOutputPort());
  picture->SetOutputDimensions(width, height, 1);
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetCompressionLevel(9);
  writer->SetInputConnection(picture->GetOutputPort());
  messages.check();
  errno = 0;
  writer->Write();
  messages.check_written(writer->GetErrorCode());
}

namespace {

vtkProperty* add(vtkRenderer* renderer, vtkPolyData* data, const Color& color) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkProperty* const look = add_actor(renderer, mapper, color);
  look->LightingOff();
  return look;
}

vtkIdType insert(vtkPoints* points, const Flat::Place& place, double depth) {
  return points->InsertNextPoint(finer * place[0], finer * place[1], depth);
}

void add_lines(vtkRenderer* renderer, const Flat::Lines& lines, double depth) {
  const auto data =
      lines_along(lines.paths, [&](vtkPoints* to, const Flat::Place& place) { return insert(to, place, depth); });
  vtkProperty* const look = add(renderer, data, lines.color);
  look->SetLineWidth(static_cast<float>(finer * lines.width));
  look->SetOpacity(lines.opacity);
}

void add_dots(vtkRenderer* renderer, const Flat::Dots& dots, double depth) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& place : dots.places) {
    const vtkIdType id = insert(points, place, depth);
    cells->InsertNextCell(1, &id);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(cells);
  vtkProperty* const look = add(renderer, data, dots.color);
  look->SetPointSize(static_cast<float>(finer * dots.size));
  look->RenderPointsAsSpheresOn();
}

void add_text(vtkRenderer* renderer, const Flat::Text& text) {
  vtkNew<vtkTextActor> actor;
  actor->SetInput(text.text.c_str());
  vtkTextProperty* const property = actor->GetTextProperty();
  property->SetFontFamilyToArial();
  property->SetFontSize(static_cast<int>(finer * text.size));
  property->SetColor(text.color[0] / 255.0, text.color[1] / 255.0, text.color[2] / 255.0);
  property->SetVerticalJustificationToCentered();
  if (text.upright) property->SetOrientation(90);
  static constexpr int justifications[] = {VTK_TEXT_LEFT, VTK_TEXT_CENTERED, VTK_TEXT_RIGHT};
  property->SetJustification(justifications[static_cast<int>(text.anchor)]);
  actor->SetPosition(finer * text.place[0], finer * text.place[1]);
  renderer->AddActor2D(actor);
}

void aim(vtkRenderer* renderer, const Flat& flat) {
  vtkCamera* const camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(finer * flat.width / 2.0, finer * flat.height / 2.0, 0);
  camera->SetPosition(finer * flat.width / 2.0, finer * flat.height / 2.0, 1000);
  camera->SetParallelScale(finer * flat.height / 2.0);
  camera->SetClippingRange(1, 2000);
}

}  // namespace

void fill(vtkRenderer* renderer, const Flat& flat) {
  double depth = 0;
  for (const auto& lines : flat.lines) add_lines(renderer, lines, depth += 1);
  for (const auto& dots : flat.dots) add_dots(renderer, dots, depth += 1);
  for (const auto& text : flat.texts) add_text(renderer, text);
  aim(renderer, flat);
}

void draw_flat(const std::string& file, const Flat& flat) {
  write_png(file, flat.width, flat.height, {[&](vtkRenderer* renderer) { fill(renderer, flat); }});
}

}  // namespace gale::app
