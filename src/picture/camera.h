#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "quasimc/mesh.h"

namespace quasimc {

/// Position of the camera: it always aims at the centre of the visible box.
struct ViewSpec {
    double azimuth_deg = 200;   ///< azimuth of the camera, from north over east
    double elevation_deg = 20;  ///< elevation of the camera, -90 to 90
    double fov_deg = 0;         ///< angle of the longer side, at most 150; 0: orthographic
    /// A point (z up) that looks up through a fisheye lens instead: the sky is a circle with the
    /// zenith in its middle, north above and east on the left; the distance from the middle is
    /// proportional to the zenith angle.
    std::optional<Vec3> fisheye = {};
};

/// A named view.
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

/// Camera rays through the pixels of a picture that shows a whole box, or of a fisheye. World, z
/// up.
class Camera {
  public:
    /// @param shown  the box, not empty
    /// @param width, height  of the picture, pixels
    Camera(
        const ViewSpec& view,
        const Orientation& axes,
        const Bounds& shown,
        double width,
        double height);

    struct CameraRay {
        Vec3 origin, direction;  ///< unit; the whole scene is ahead
    };
    /// Nothing outside of the circle of a fisheye.
    [[nodiscard]] std::optional<CameraRay> through(const PixelPoint& pixel) const;
    [[nodiscard]] PixelPoint pixel_of(const Vec3& point) const;
    /// A direction of the world in camera coordinates: right, up, towards the camera.
    [[nodiscard]] Vec3 seen(const Vec3& direction) const;
    /// Pixels per unit of length, in the plane through the centre of the box.
    [[nodiscard]] double scale() const { return scale_; }
    [[nodiscard]] bool is_parallel() const { return distance_ == 0; }
    [[nodiscard]] bool is_fisheye() const { return is_fisheye_; }

  private:
    [[nodiscard]] std::optional<CameraRay> through_fisheye(double x, double y) const;

    bool is_fisheye_;
    Vec3 middle_, right_, up_, back_;
    double half_width_, half_height_;
    double scale_ = 1;
    double distance_ = 0;  // from the camera to the centre; 0: orthographic
    double start_ = 0;     // of orthographic rays, before the centre
};

}  // namespace quasimc
