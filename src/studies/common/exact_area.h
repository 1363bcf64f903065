#pragma once

#include <vector>

#include "sampling/field.h"

/// Areas in closed form, in the image frame (pixels, x right, y down): what the studies measure errors
/// against.
namespace ifov::studies {

struct Disc {
  double x_px = 0.0, y_px = 0.0, radius_px = 0.0;
};

/// Corners in order, either way round; simple, need not be convex.
using Outline = std::vector<sampling::FocalPoint>;

/// Area of what a disc and the rectangle [x0, x1] x [y0, y1] share, px^2.
double area_in_rectangle(const Disc& disc, double x0_px, double y0_px, double x1_px, double y1_px);

/// The same for a polygon: Sutherland and Hodgman's clipping, then the shoelace formula.
double area_in_rectangle(const Outline& outline, double x0_px, double y0_px, double x1_px, double y1_px);

/// What is left of a polygon where a x + b y <= c.
Outline clip_half_plane(const Outline& outline, double a, double b, double c);

double area(const Outline& outline);

/// An oblong about a centre, its length at `angle_rad` from +x towards +y.
Outline oblong(double x_px, double y_px, double length_px, double width_px, double angle_rad);

}  // namespace ifov::studies
