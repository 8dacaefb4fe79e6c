#pragma once

#include <functional>
#include <string>
#include <vector>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <gale/app/drawing/scene.hpp>

namespace gale::app {

/// Pictures are drawn so many times as large and made smaller, for smooth outlines.
constexpr int finer = 2;

/// For a picture of that size, without a window on the screen.
vtkSmartPointer<vtkRenderWindow> make_window(int width, int height);

/// What adds something to a renderer, and aims its camera.
using Fill = std::function<void(vtkRenderer*)>;

/// Adds a flat drawing.
void fill(vtkRenderer* renderer, const Flat& flat);

/// Draws on white what each of `layers` adds, one over the other, and writes it as a PNG. Throws std::runtime_error.
void write_png(const std::string& file, int width, int height, const std::vector<Fill>& layers);

/// What the module draws (drawer.hpp).
void draw_flat(const std::string& file, const Flat& flat);

/// Adds what a mapper draws in a colour, unless that has colours of its own; returns how it looks.
inline vtkProperty* add_actor(vtkRenderer* renderer, vtkMapper* mapper, const Color& color) {
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
  renderer->AddActor(actor);
  return actor->GetProperty();
}

/// Lines along paths, whose places insert(points, place) adds to the points.
template <class Path, class Insert>
vtkNew<vtkPolyData> lines_along(const std::vector<Path>& paths, const Insert& insert) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  for (const Path& path : paths) {
    lines->InsertNextCell(static_cast<int>(path.size()));
    for (const auto& place : path) lines->InsertCellPoint(insert(points, place));
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  return data;
}

}  // namespace gale::app
