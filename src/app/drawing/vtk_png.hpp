#pragma once

#include <functional>
#include <vector>

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <gale/io/atomic_file.hpp>

class vtkRenderer;

namespace gale::app {

struct Flat;

/// Pictures are drawn so many times as large and made smaller, for smooth outlines.
constexpr int finer = 2;

/// For a picture of that size, without a window on the screen.
vtkSmartPointer<vtkRenderWindow> make_window(int width, int height);

/// What adds something to a renderer, and aims its camera.
using Fill = std::function<void(vtkRenderer*)>;

/// Adds a flat drawing.
void fill(vtkRenderer* renderer, const Flat& flat);

/// Draws on white what each of `layers` adds, one over the other, and writes it as a PNG. Throws gale::Error.
void write_png(const io::AtomicFile& file, int width, int height, const std::vector<Fill>& layers);

}  // namespace gale::app
