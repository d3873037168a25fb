// The table of gap fractions: docs/reference/gap-fraction.md.

#include <utility>

#include "resultio/csv_parts.h"
#include "resultio/gap_texts.h"
#include "resultio/output_input.h"

namespace quasimc {
namespace {

/// Measures the gaps of each run once its light is computed.
class GapTable final : public OutputWriter {
  public:
    explicit GapTable(const OutputInput& input) : run_(&input.run), sink_(input.sink) {}

    void next_run(const RunFile& run, const SeriesSummary& /*series_summary*/) override {
        write_run();
        run_ = &run;
    }
    void finish(const SeriesSummary& /*series_summary*/) override { write_run(); }

  private:
    void write_run() {
        if (!std::exchange(has_head_, true)) {
            write_head();
        }
        for (GapFractionSpec spec : run_->gap_fractions) {
            spec.threads = run_->spec.threads;
            sink_(gap_rows(gap_fractions(run_->scene, spec), csv_point_fields(*run_)));
        }
    }

    void write_head() const {
        sink_(
            csv_origin(*run_, "table of gap fractions") + csv_point_columns(*run_) +
            gap_header(csv_point_names(*run_)));
    }

    const RunFile* run_;
    TextSink sink_;
    bool has_head_ = false;
};

}  // namespace

std::unique_ptr<OutputWriter> make_gaps_csv(const OutputInput& input) {
    return std::make_unique<GapTable>(input);
}

}  // namespace quasimc
