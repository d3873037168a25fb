#pragma once

#include <array>
#include <string_view>

#include "quasimc/mesh.h"

namespace quasimc {

/// Where a scene is looked at from: always towards the middle of what is shown.
struct ViewSpec {
    double azimuth_deg = 200;   ///< of the camera, from north over east
    double elevation_deg = 20;  ///< of the camera, -90 to 90
    double opening_deg = 0;     ///< angle that the longer side of the picture spans; 0: parallel
                                ///< lines of sight, at most 150
};

/// A view that has a name.
struct NamedView {
    std::string_view name;
    double azimuth_deg, elevation_deg;
};
[[nodiscard]] const std::array<NamedView, 6>& view_table();
[[nodiscard]] const NamedView* find_view(std::string_view name);

/// A point in a picture, pixels from its top left corner.
struct PixelPoint {
    double x = 0, y = 0;
};

/// Lines of sight through the pixels of a picture that shows a box whole. World, z up.
class Camera {
  public:
    /// @param shown  not empty
    /// @param width, height  of the picture, pixels
    Camera(
        const ViewSpec& view,
        const Orientation& axes,
        const Bounds& shown,
        double width,
        double height);

    struct CameraRay {
        Vec3 origin, direction;  ///< unit; all the scene is ahead
    };
    [[nodiscard]] CameraRay through(const PixelPoint& pixel) const;
    [[nodiscard]] PixelPoint pixel_of(const Vec3& point) const;
    /// A direction of the world as it is seen: to the right, upwards, towards the eye.
    [[nodiscard]] Vec3 seen(const Vec3& direction) const;
    /// Pixels to a unit of length, in the plane through the middle of what is shown.
    [[nodiscard]] double scale() const { return scale_; }
    [[nodiscard]] bool is_parallel() const { return distance_ == 0; }

  private:
    Vec3 middle_, right_, up_, back_;
    double half_width_, half_height_;
    double scale_ = 1;
    double distance_ = 0;  // of the eye from the middle; 0: lines of sight are parallel
    double start_ = 0;     // of parallel lines of sight, before the middle
};

}  // namespace quasimc
