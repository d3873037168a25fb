#pragma once

namespace quasimc {

/// The partition of the paths of light from suns and lamps by the strategy that samples them, as
/// multiple importance sampling divides them (Veach 1997), but with weights 0 and 1.
///
/// Points of organs sample most paths: by next-event estimation, and near lamps by connections with
/// light vertices. Light subpaths sample the others. A subpath is in one class at a time, which
/// changes where it is scattered; the class with which it arrives decides whether its light counts.
/// A lobe is sharp from followed_peak() on, broad below; near is LampNearField.
enum class PathClass {
    /// Light has left its source and met no surface. Points sample it, except where it falls on
    /// an organ in the near field.
    from_source,
    /// Light has left a light vertex by a broad lobe. Points of connected regions sample what
    /// it lights next, unless that is closer than the shortest connection.
    from_light_vertex,
    /// Light has gone further than the shortest connection from its last light vertex, and on by a
    /// broad lobe. Points of connected regions sample it, all of it.
    connected,
    /// Light was scattered first by a sharp lobe, or in the near field where no region is
    /// connected, or left a light vertex or a connected surface by a sharp lobe. Points do not
    /// sample it: it counts everywhere.
    sampled_from_source,
};

/// Whether a point of an organ could take over a path of a class at its next surface.
[[nodiscard]] constexpr bool meets_points(PathClass path) {
    return path == PathClass::from_source || path == PathClass::from_light_vertex;
}

}  // namespace quasimc
