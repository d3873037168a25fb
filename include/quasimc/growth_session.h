#pragma once

// Growth: organs that come, change and go between the steps of a simulation.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "quasimc/run.h"
#include "quasimc/scene.h"
#include "quasimc/source.h"

namespace quasimc {

/// The scenes of a growing canopy, one after the other, and their light. A step's result is bit for
/// bit that of quasimc::run for a scene of the same organs in the same order.
///
/// What is kept from step to step: the organs, so that a step states what changes alone; the scene,
/// if no organ changed; the acceleration structure, if no triangle, period or engine changed,
/// whatever happens to optics, sources and options; the tables of samplers. When some triangle
/// changed, the scene is put together and the acceleration structure is built anew, both in time in
/// proportion to all triangles; what takes longest in the former, the search for triangles that lie
/// on each other, looks at those that changed and what is near them
/// (docs/develop/decisions/growth-steps.md).
class GrowthSession {
  public:
    /// @param frame  bands, materials, ground, cell and all that stays; its organs, if any, come
    ///        first and can't be changed. Its faults are told when the scene is built
    explicit GrowthSession(SceneBuilder frame);
    ~GrowthSession();
    GrowthSession(GrowthSession&& other) noexcept;
    GrowthSession& operator=(GrowthSession&& other) noexcept;

    /// Replaces what is not an organ of the session: other optics, another ground.
    /// @throws InputError  if one of its organs has the id of an organ of the session; nothing is
    ///         replaced then
    void set_frame(SceneBuilder frame);

    /// Adds organs behind the others, all or, if one is refused, none. Without an id an organ gets
    /// one more than the largest that the session and its frame ever had.
    /// @returns their ids. @throws InputError  if the session or its frame has an organ of such an
    ///          id, or two of these have the same, or SceneBuilder::check_organs() refuses one;
    ///          with all faults at once
    std::vector<std::int64_t> add(std::vector<OrganSpec> organs);
    std::int64_t add(OrganSpec organ);
    /// Puts organs in the places of those of the same ids, all or none. @throws InputError  if the
    /// session has not all of them, one is stated twice, or SceneBuilder::check_organs() refuses
    /// one
    void change(std::vector<OrganSpec> organs);
    void change(OrganSpec organ);
    /// Removes organs, all or none. @throws InputError  if the session has not all of them, or one
    /// is stated twice
    void remove(std::span<const std::int64_t> ids);
    void remove(std::int64_t id);
    /// Whether the session has an organ of this id. Those of the frame do not count.
    [[nodiscard]] bool has(std::int64_t id) const;
    /// Organs of the session: those that were added and not removed, without those of the frame.
    [[nodiscard]] std::size_t size() const;

    /// The scene of this step. @throws InputError  as SceneBuilder::build; the session may be
    ///         mended and used on
    [[nodiscard]] std::shared_ptr<const Scene> scene();
    /// What lint() says of the scene of this step. Looked for when it is first asked for after a
    /// change, in time in proportion to all triangles; run() does not ask.
    /// @throws InputError  as scene()
    [[nodiscard]] const std::vector<Warning>& warnings();
    /// The light of this step; as Simulator::run.
    [[nodiscard]] Result run(
        const Sources& sources, const RunSpec& spec, const RunControl& control = {});

    /// Where organs stand in the scene and in its results, in the order asked.
    /// @throws InputError  if one is not there
    [[nodiscard]] std::vector<std::size_t> places_of(std::span<const std::int64_t> ids);

    /// How often a scene, and how often an acceleration structure, had to be made.
    [[nodiscard]] std::size_t scene_builds() const;
    [[nodiscard]] std::size_t tree_builds() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace quasimc
