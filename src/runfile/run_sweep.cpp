// The runs of a run file: one for each point of its sweep.

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "meshio/mesh_cache.h"
#include "options/options.h"
#include "runfile/run_file.h"
#include "runfile/sweep.h"
#include "runfile/sweep_rows.h"
#include "runfile/written.h"
#include "scene/fold_warnings.h"
#include "scene/overlap/known_overlaps.h"
#include "scene/scene.h"

namespace quasimc {

/// The bytes of files, each read from the disk once for all points.
class FileCache {
  public:
    [[nodiscard]] InputFiles::Reader around(InputFiles::Reader reader) {
        return [this, reader = std::move(reader)](const std::filesystem::path& path) {
            const auto known = bytes_.find(path.string());
            return known != bytes_.end()
                       ? known->second
                       : bytes_.emplace(path.string(), reader(path)).first->second;
        };
    }

  private:
    std::map<std::string, std::string> bytes_;
};

namespace {

/// Number of faults after which no more points are read.
constexpr std::size_t kMaxPointFaults = 100;

/// All keys of the organs' labels, in order, which become columns.
std::set<std::string> label_keys_of(const Scene& scene) {
    std::set<std::string> keys;
    for (const Organ& organ : scene.organs()) {
        for (const auto& [key, value] : organ.labels) {
            keys.insert(key);
        }
    }
    return keys;
}

}  // namespace

/// State of a RunSweep.
class RunSweep::State {
  public:
    State(
        Node document,
        std::string name,
        std::function<InputFiles()> files,
        std::vector<Override> overrides,
        const OnPointRead& on_point)
        : document_(std::move(document)),
          files_(std::move(files)),
          overrides_(std::move(overrides)),
          reporter_{std::move(name), {}, {}},
          plan_(document_, reporter_) {
        check_overrides();
        read_all(on_point);
        if (!reporter_.faults.empty()) {
            std::vector<Fault> faults = reporter_.faults.all();
            sort_by_line(faults, reporter_.file);
            throw InputError(std::move(faults));
        }
        finish();
    }

    [[nodiscard]] std::size_t size() const { return plan_.points(); }
    [[nodiscard]] bool is_swept() const { return !plan_.keys().empty(); }
    [[nodiscard]] const std::vector<Warning>& warnings() const { return reporter_.warnings; }
    [[nodiscard]] const std::string& name() const { return reporter_.file; }

    [[nodiscard]] RunFile take(std::size_t point) {
        if (!is_swept()) {
            return std::move(*first_);
        }
        RunFile run = point == 0 ? *first_ : read(point);
        run.point = point;
        run.sweep = points_;
        run.document = first_->document;
        run.inputs = first_->inputs;
        return run;
    }

  private:
    /// A fault, the first point with it, and the number of points with it.
    struct PointFault {
        Fault fault;
        std::size_t first = 0, points = 0;
    };

    /// Refuses flags that would override swept keys.
    void check_overrides() {
        for (const Override& given : overrides_) {
            for (const SweptKey& key : plan_.keys()) {
                if (key.from_top() == "run." + given.key) {
                    reporter_.faults.add(
                        {given.where, "is swept by the run file",
                         fmt::format("{} has {} values there", key.path, key.values.size()),
                         "remove it here or there"});
                }
            }
        }
    }

    [[nodiscard]] RunFile read(std::size_t point) {
        if (document_.find("sweep") == nullptr) {
            InputFiles files = files_();
            return read_run_document(document_, reporter_.file, files, overrides_);
        }
        Reporter own{reporter_.file, {}, {}};
        Node document = plan_.document_at(document_, point, own);
        own.faults.throw_if_any();
        InputFiles files = files_();
        files.read_through([this](auto reader) { return cache_.around(std::move(reader)); });
        const KnownScene known{
            .same = first_ && plan_.keeps_geometry() ? &first_->scene : nullptr,
            .overlaps = plan_.keeps_geometry() ? nullptr : &overlaps_,
            .meshes = plan_.keeps_geometry() ? nullptr : &meshes_};
        return read_run_document(
            std::move(document), reporter_.file, files, overrides_, known, NoLightPolicy::allowed);
    }

    [[nodiscard]] bool is_full() const {
        return reporter_.is_full() || point_faults_.size() >= kMaxPointFaults;
    }

    void read_all(const OnPointRead& on_point) {
        for (std::size_t i = 0; i < size() && !is_full(); ++i) {
            if (on_point && is_swept()) {
                on_point(i, size());
            }
            try {
                note(i, read(i));
            } catch (const InputError& error) {
                add_new(i, error);
            }
        }
        for (PointFault& each : point_faults_) {
            reporter_.faults.add(named(std::move(each)));
        }
        warn_of_darkness();
    }

    /// Adds the faults of a point, each text once, as most occur at all points.
    void add_new(std::size_t point, const InputError& error) {
        for (const Fault& fault : error.faults()) {
            const auto [known, is_new] =
                indices_of_faults_.try_emplace(fault.text(), point_faults_.size());
            if (is_new) {
                point_faults_.push_back({fault, point, 1});
            } else {
                ++point_faults_[known->second].points;
            }
        }
    }

    /// Adds the point to the location of a fault that only some points have, unless it has a line.
    [[nodiscard]] Fault named(PointFault each) const {
        const std::string line = reporter_.file + ":";
        const bool has_line = each.fault.where.starts_with(line) &&
                              each.fault.where.substr(line.size()).find_first_of("0123456789") == 0;
        if (is_swept() && !has_line && each.points < size()) {
            each.fault.where += ", " + describe_point_at(each.first);
        }
        return std::move(each.fault);
    }

    /// "point 3 (seed = 2)".
    [[nodiscard]] std::string describe_point_at(std::size_t point) const {
        return fmt::format(
            "point {} ({})", point + 1, describe_point({plan_.values_at(point), {}}));
    }

    void warn_of_darkness() {
        if (dark_points_ > 0) {
            reporter_.warn(fmt::format(
                "[sweep]: no source gives light at {} of {} points, and all results are 0; the "
                "first is {}",
                dark_points_, size(), describe_point_at(first_dark_)));
        }
    }

    void note(std::size_t point, RunFile run) {
        for (const Warning& warning : run.warnings) {
            if (sent_.insert({warning.where, warning.text}).second) {
                reporter_.warnings.push_back(warning);
            }
        }
        for (const InputFile& input : run.inputs) {
            const auto has_path = [&](const InputFile& each) {
                return each.absolute_path == input.absolute_path;
            };
            if (std::none_of(inputs_.begin(), inputs_.end(), has_path)) {
                inputs_.push_back(input);
            }
        }
        points_->push_back({plan_.values_at(point), run.source_notes, plan_.weight_at(point)});
        check_summed_tables(point, run);
        if (is_swept() && !run.series && is_dark(run.sources)) {
            first_dark_ = dark_points_++ == 0 ? point : first_dark_;
        }
        if (!first_) {
            labels_ = label_keys_of(run.scene);
            first_ = std::move(run);
        } else if (!plan_.keeps_geometry() && label_keys_of(run.scene) != labels_) {
            reporter_.faults.add(
                {reporter_.file, fmt::format("point {}: its organs have other labels", point + 1),
                 "labels are columns and must be the same for all points",
                 "give all organs the same keys"});
        }
    }

    /// Refuses sums over points whose rows differ, or whose replicates can't be paired.
    void check_summed_tables(std::size_t point, const RunFile& run) {
        for (const TableSpec& table : run.output.tables) {
            if (table.times != CsvTimes::sweep) {
                continue;
            }
            std::optional<Fault> fault =
                !is_swept() ? Fault{table.location, "per = \"sweep\" without [sweep]",
                                    "it is a sum over the points of a sweep", ""}
                : first_ ? difference_of_rows(*first_, run, table)
                         : std::nullopt;
            if (fault && unmatched_.insert(table.location).second) {
                fault->problem = is_swept() ? fmt::format(
                                                  "per = \"sweep\": {} {}",
                                                  describe_point_at(point), fault->problem)
                                            : fault->problem;
                reporter_.faults.add(*std::move(fault));
            }
        }
    }

    void finish() {
        first_->inputs = inputs_;
        if (is_swept()) {
            reporter_.warnings = fold_warnings(std::move(reporter_.warnings));
        }
        first_->warnings = reporter_.warnings;
        if (is_swept()) {
            // With [sweep], which overrides its keys in [run].
            first_->document = completed_document();
        }
    }

    [[nodiscard]] std::shared_ptr<const Node> completed_document() const {
        Node document = document_;
        const Node* run = first_->document->find("run");
        auto& members = std::get<Node::Table>(document.value);
        std::erase_if(members, [](const Member& member) { return member.key == "run"; });
        members.push_back({"run", 0, *run});
        return std::make_shared<const Node>(std::move(document));
    }

    Node document_;
    std::function<InputFiles()> files_;
    std::vector<Override> overrides_;
    Reporter reporter_;
    SweepPlan plan_;
    FileCache cache_;
    KnownOverlaps overlaps_;  // of the last point read
    MeshCache meshes_;
    std::optional<RunFile> first_;
    std::vector<InputFile> inputs_;
    std::set<std::pair<std::string, std::string>> sent_;
    std::set<std::string> labels_;
    std::set<std::string> unmatched_;  // tables of which a fault was reported
    std::vector<PointFault> point_faults_;
    std::unordered_map<std::string, std::size_t> indices_of_faults_;  // by text
    std::size_t dark_points_ = 0, first_dark_ = 0;
    std::shared_ptr<std::vector<SweepPoint>> points_ = std::make_shared<std::vector<SweepPoint>>();
};

RunSweep::RunSweep(std::unique_ptr<State> state) : state_(std::move(state)) {}
RunSweep::RunSweep(RunSweep&& other) noexcept = default;
RunSweep& RunSweep::operator=(RunSweep&& other) noexcept = default;
RunSweep::~RunSweep() = default;

std::size_t RunSweep::size() const {
    return state_->size();
}

RunFile RunSweep::take(std::size_t point) {
    return state_->take(point);
}

RunFile RunSweep::only_run() && {
    if (state_->is_swept()) {
        throw InputError(
            {{state_->name(), fmt::format("it has a [sweep] of {} points", state_->size()),
              "a single run is needed", "leave [sweep] out"}});
    }
    return state_->take(0);
}

const std::vector<Warning>& RunSweep::warnings() const {
    return state_->warnings();
}

RunSweep read_sweep_document(
    Node document,
    const std::string& name,
    std::function<InputFiles()> files,
    const std::vector<Override>& overrides,
    const OnPointRead& on_point) {
    return RunSweep(std::make_unique<RunSweep::State>(
        std::move(document), name, std::move(files), overrides, on_point));
}

}  // namespace quasimc
