#pragma once

namespace quasimc {

/// The partition of the paths of light from suns and lamps by the strategy that samples them, as
/// multiple importance sampling divides them (Veach 1997), but with weights 0 and 1.
///
/// Points of organs sample most paths: by next-event estimation, and near lamps by connections with
/// light vertices. Light subpaths sample the others. A subpath is in one class at a time, which
/// changes where it is scattered; the class with which it arrives decides whether its light counts.
///
/// In Heckbert's notation, as in docs/theory/light-tracing.md: S is a source, D scattering by a
/// broad lobe, N by a narrow one (followed_peak()), V by a broad one in the near field of a lamp
/// (LampNearField), X any scattering.
enum class PathClass {
    /// S: light from its source that has met no surface. Points sample it, except on an organ in
    /// the near field.
    from_source,
    /// S V+: light from a light vertex by a broad lobe. Points of connected regions sample it on
    /// the next surface, unless that is closer than the shortest connection.
    from_light_vertex,
    /// S V+ D X*: light that went further than the shortest connection from its last light vertex,
    /// and on by a broad lobe. Points of connected regions sample all of it.
    connected,
    /// S N X*, S V+ N X*, and S V X* if no region is connected. Points do not sample it: it counts
    /// everywhere.
    sampled_from_source,
};

/// Whether a point of an organ could take over a path of a class at its next surface.
[[nodiscard]] constexpr bool meets_points(PathClass path) {
    return path == PathClass::from_source || path == PathClass::from_light_vertex;
}

}  // namespace quasimc
