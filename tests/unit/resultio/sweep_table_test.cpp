// Tables of the sum over the points of a sweep.

#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "quasimc/series.h"
#include "resultio/output_input.h"
#include "text/line_scanner.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

const std::string kHours =
    "[site]\nlatitude_deg = 50\nlongitude_deg = 8\n[time]\nday = '2024-06-21'\n"
    "utc_offset_hours = 1\nhours = [10, 13]\n";

/// Two leaves above a ground, lit by a low sun.
std::string stand(const std::string& rest) {
    RunText text;
    text.top = "bands = ['R', 'FR']\n";
    text.run = "[run]\npaths = 256\nreplicates = 4\ngroups = ['plant']\n";
    text.sources =
        "[[source]]\ntype = 'directional'\nname = 'sun'\ndirection = [1, 0, -1]\n"
        "irradiance_facing = [1, 2]\n";
    text.materials =
        "[[material]]\nname = 'leaf'\nreflectance = [0.1, 0.4]\ntransmittance = [0.1, 0.4]\n";
    const auto leaf = [](int plant, double height) {
        const std::string z = std::to_string(height);
        return "[[organ]]\nmaterial = 'leaf'\nlabels = { plant = " + std::to_string(plant) +
               " }\nshape = 'triangle'\ncorners = [[0, 0, " + z + "], [2, 0, " + z + "], [0, 2, " +
               z + "]]\n";
    };
    text.organs = leaf(1, .5) + leaf(2, 1);
    text.rest = "[ground]\nmaterial = 'leaf'\nx = [-1, 3]\ny = [-1, 3]\n" + rest;
    return text.text();
}

RunSweep sweep_of(const std::string& text) {
    const InputFiles files("/run");
    return read_sweep_document(read_toml(text, "run.toml"), "run.toml", [files] { return files; });
}

/// The rows of each table of a sweep, each a list of fields; the header first.
using Rows = std::vector<std::vector<std::string>>;

Rows fields_of(const std::string& text) {
    Rows rows;
    LineScanner scanner(text);
    while (scanner.next()) {
        if (scanner.line().starts_with('#')) {
            continue;
        }
        rows.emplace_back(1);
        bool is_quoted = false;
        for (const char c : scanner.line()) {
            is_quoted = is_quoted != (c == '"');
            if (c == ',' && !is_quoted) {
                rows.back().emplace_back();
            } else {
                rows.back().back().push_back(c);
            }
        }
    }
    return rows;
}

/// The texts of the tables of a sweep. @param points  computed; by default all
std::vector<std::string> written(const std::string& text, std::size_t points = 100) {
    RunSweep sweep = sweep_of(text);
    std::unique_ptr<RunFile> run = std::make_unique<RunFile>(sweep.take(0));
    std::vector<std::string> texts(run->output.tables.size());
    std::vector<std::unique_ptr<OutputWriter>> writers;
    const RunFile first = *run;
    RunControl control;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const TextSink sink = [&texts, i](std::string_view piece) { texts[i] += piece; };
        writers.push_back(make_table({*run, sink, "", "", &first.output.tables[i]}));
        control.listeners.push_back(writers.back().get());
    }
    SeriesSummary summary;
    Simulator simulator;
    for (std::size_t point = 0; point < std::min(points, sweep.size()); ++point) {
        if (point > 0) {
            auto next = std::make_unique<RunFile>(sweep.take(point));
            for (const auto& writer : writers) {
                writer->next_run(*next, summary);
            }
            run = std::move(next);
        }
        summary = run_series(run->scene, time_steps_of(*run, simulator), run->spec, control);
    }
    for (const auto& writer : writers) {
        writer->finish(summary);
    }
    return texts;
}

/// The numbers of a row from a column on; NaN where there is none.
std::vector<double> numbers_from(const std::vector<std::string>& row, std::size_t column) {
    std::vector<double> numbers;
    for (std::size_t i = column; i < row.size(); ++i) {
        numbers.push_back(row[i].empty() ? std::nan("") : std::stod(row[i]));
    }
    return numbers;
}

void expect_near(double found, double expected, const std::string& what) {
    if (std::isnan(expected)) {
        EXPECT_TRUE(std::isnan(found)) << what << found;
    } else {
        EXPECT_NEAR(found, expected, 1e-12 * (1 + std::abs(expected))) << what;
    }
}

/// Compares rows of a sum from a column on with weighted rows of the points.
/// @param first  column of the first number of the points, which have `before` more
void expect_weighted(
    const Rows& sum,
    const Rows& points,
    const std::vector<double>& weights,
    std::size_t first,
    std::size_t before,
    std::size_t step) {
    const std::size_t rows = sum.size() - 1;
    ASSERT_GT(rows, 0U);
    ASSERT_EQ(points.size(), 1 + rows * weights.size());
    for (std::size_t row = 1; row <= rows; ++row) {
        const std::vector<double> found = numbers_from(sum[row], first);
        for (std::size_t i = 0; i < found.size(); i += step) {
            double expected = 0;
            for (std::size_t p = 0; p < weights.size(); ++p) {
                const auto& own = points[p * rows + row];
                expected += weights[p] * numbers_from(own, first + before)[i];
            }
            expect_near(found[i], expected, sum[0][first + i]);
        }
    }
}

const std::string kMeans = "statistics = ['mean']\n";

std::string table(const std::string& file, const std::string& keys) {
    return "[[table]]\nfile = '" + file + "'\n" + keys;
}

TEST(SweepTable, HasTheWeightedMeansOfOrgans) {
    const auto texts = written(stand(
        "[sweep]\nsource.sun.direction = [[1, 0, -1], [0, 1, -2], [0, 0, -1]]\n"
        "weights = [1, 2, 5]\n" +
        table("sum.csv", "per = 'sweep'\nquantities = ['absorbed_flux', 'incident_lower']\n") +
        table("each.csv", "quantities = ['absorbed_flux', 'incident_lower']\n")));
    const Rows sum = fields_of(texts[0]);
    ASSERT_EQ(sum.size(), 4U);
    EXPECT_EQ(
        sum[0][0] + "," + sum[0][1] + "," + sum[0][2] + "," + sum[0][3], "id,name,area,plant");
    EXPECT_NE(
        texts[0].find("# weighted means of all points of the sweep; weights: 1, 2, 5\n"),
        std::string::npos)
        << texts[0];
    EXPECT_NE(texts[0].find("absorbed_flux_R [W]"), std::string::npos);
    expect_weighted(sum, fields_of(texts[1]), {1 / 8., 2 / 8., 5 / 8.}, 4, 1, 3);
}

/// Points that are the same run differ in nothing: neither does their mean, nor its error. Squares
/// of errors would add up to less.
TEST(SweepTable, OfEqualPointsHasTheEstimatesOfOne) {
    for (const std::string rows : {"organs", "groups", "sensors"}) {
        // Means within physical bounds, which sums do not have.
        const std::string keys = "rows = '" + rows +
                                 "'\nbands = ['FR']\n"
                                 "quantities = ['incident_lower', 'incident_scattered']\n";
        const auto texts = written(stand(
            "[[sensors]]\nname = 's'\nat = [[0.5, 0.5, 0.2]]\n"
            "[sweep]\nmaterial.leaf.reflectance = [[0.1, 0.4], [0.1, 0.4]]\nweights = [1, 3]\n" +
            table("sum.csv", keys + "per = 'sweep'\n") + table("each.csv", keys)));
        const Rows sum = fields_of(texts[0]), each = fields_of(texts[1]);
        ASSERT_EQ(2 * (sum.size() - 1), each.size() - 1) << rows;
        const std::size_t first = sum[0].size() - 6;
        for (std::size_t row = 1; row < sum.size(); ++row) {
            const auto found = numbers_from(sum[row], first);
            const auto one = numbers_from(each[row], first + 1);
            for (std::size_t i = 0; i < found.size(); ++i) {
                expect_near(found[i], one[i], sum[0][first + i]);
            }
            EXPECT_GT(found[4], 0);
        }
    }
}

TEST(SweepTable, OfTimesHasTheWeightedSumsOfPeriods) {
    for (const std::string rows : {"organs", "groups"}) {
        const std::string keys =
            "rows = '" + rows + "'\nquantities = ['absorbed_flux', 'incident_upper']\n" + kMeans;
        const auto texts = written(stand(
            kHours + "[sweep]\ntime.day = ['2024-01-15', '2024-06-15']\nweights = [31, 30]\n" +
            table("sum.csv", keys + "per = 'sweep'\n") +
            table("each.csv", keys + "per = 'period'\n")));
        const Rows sum = fields_of(texts[0]);
        EXPECT_EQ(sum[0][0], "seconds");
        EXPECT_EQ(sum[1][0], "658800") << "61 days of 3 hours";
        EXPECT_NE(texts[0].find("absorbed_flux_R [J]"), std::string::npos) << texts[0];
        const std::size_t first = rows == "groups" ? 6 : 5;
        expect_weighted(sum, fields_of(texts[1]), {31, 30}, first, 2, 1);
    }
}

TEST(SweepTable, HasTheSumsOfDaylightCoefficients) {
    const std::string keys = "bands = ['R']\nquantities = ['absorbed_flux']\n" + kMeans;
    std::string text = stand(
        kHours + "[sweep]\ntime.day = ['2024-03-15', '2024-06-15']\nweights = [31, 30]\n" +
        table("sum.csv", keys + "per = 'sweep'\n") + table("each.csv", keys + "per = 'period'\n"));
    text.replace(
        text.find("paths"), 5,
        "method = 'ray_bundles'\ntime_method = 'daylight_coefficients'\npaths");
    text.erase(text.find("[[source]]"), text.find("[[material]]") - text.find("[[source]]"));
    const auto texts = written(text);
    expect_weighted(fields_of(texts[0]), fields_of(texts[1]), {31, 30}, 5, 2, 1);
}

TEST(SweepTable, HasTheLightOfOrigins) {
    std::string text = stand(
        kHours + "[sweep]\ntime.day = ['2024-03-15', '2024-06-15']\n" +
        table("sum.csv", "per = 'sweep'\n" + kMeans) +
        table("each.csv", "per = 'period'\n" + kMeans));
    text.replace(text.find("paths"), 5, "origins = ['sun', 'sky']\npaths");
    const auto texts = written(text);
    const Rows sum = fields_of(texts[0]);
    EXPECT_EQ(sum[0].back(), "incident_scattered_FR_from_sky");
    expect_weighted(sum, fields_of(texts[1]), {1, 1}, 5, 2, 1);
}

/// Fractions are quotients of sums.
TEST(SweepTable, HasTheSharesOfGroups) {
    const std::string quantities =
        "quantities = ['fraction_incident', 'fraction_absorbed', 'reflectance', 'transmittance', "
        "'absorptance', 'ground_absorptance']\n";
    const auto texts = written(stand(
        "[sweep]\nsource.sun.irradiance_facing = [[1, 2], [0, 0], [3, 6]]\nweights = [1, 7, 2]\n" +
        table("sum.csv", "rows = 'groups'\nper = 'sweep'\nbands = ['R']\n" + quantities) +
        table("each.csv", "rows = 'groups'\nbands = ['R']\n" + quantities)));
    const Rows sum = fields_of(texts[0]), each = fields_of(texts[1]);
    ASSERT_EQ(sum.size(), 4U);
    for (std::size_t row = 1; row < sum.size(); ++row) {
        // Light of any brightness is divided equally, in each replicate.
        const auto found = numbers_from(sum[row], 5), one = numbers_from(each[row], 6);
        for (std::size_t i = 0; i < found.size(); ++i) {
            expect_near(found[i], one[i], sum[0][5 + i]);
        }
        const bool has_fractions = row == 1;
        for (std::size_t i = 6; i < found.size(); i += 3) {
            EXPECT_EQ(found[i] > 0 && found[i + 1] > 0, has_fractions) << sum[0][5 + i];
        }
    }
}

/// The fraction of a sum is not the mean of fractions, but weighs them by the light on the
/// horizontal: here 1 and sqrt(2).
TEST(SweepTable, WeighsFractionsOfTheCanopyByTheLight) {
    const std::string keys =
        "rows = 'groups'\nbands = ['R']\nquantities = ['absorptance', 'transmittance']\n" + kMeans;
    const auto texts = written(stand(
        "[sweep]\nsource.sun.direction = [[1, 0, -1], [0, 0, -1]]\nweights = [1, 2]\n" +
        table("sum.csv", keys + "per = 'sweep'\n") + table("each.csv", keys)));
    const Rows sum = fields_of(texts[0]), each = fields_of(texts[1]);
    const auto found = numbers_from(sum[1], 5);
    const auto first = numbers_from(each[1], 6), second = numbers_from(each[sum.size()], 6);
    ASSERT_EQ(found.size(), 2U);
    const double weight = 2 * std::sqrt(2.0);
    for (std::size_t i = 0; i < found.size(); ++i) {
        expect_near(found[i], (first[i] + weight * second[i]) / (1 + weight), sum[0][5 + i]);
        EXPECT_GT(std::abs(first[i] - second[i]), 1e-3);
    }
}

/// The quotient of sums of light on a sensor, and on the horizontal.
TEST(SweepTable, WeighsTheTransmittanceOfSensorsByTheLight) {
    const std::string keys =
        "rows = 'sensors'\nbands = ['R']\nquantities = ['transmittance']\n"
        "statistics = ['mean', 'se']\n";
    const auto texts = written(stand(
        "[[sensors]]\nname = 's'\nat = [[0.5, 0.5, 0.2], [0.5, 0.5, 5]]\n"
        "[sweep]\nsource.sun.direction = [[1, 0, -1], [0, 0, -1]]\nweights = [1, 2]\n" +
        table("sum.csv", keys + "per = 'sweep'\n") + table("each.csv", keys)));
    const Rows sum = fields_of(texts[0]), each = fields_of(texts[1]);
    ASSERT_EQ(sum.size(), 3U);
    ASSERT_EQ(each.size(), 5U);
    const double weight = 2 * std::sqrt(2.0);
    const std::size_t first = sum[0].size() - 2;
    for (const std::size_t row : {1, 2}) {
        const double found = numbers_from(sum[row], first)[0];
        const double a = numbers_from(each[row], first + 1)[0];
        const double b = numbers_from(each[row + 2], first + 1)[0];
        expect_near(found, (a + weight * b) / (1 + weight), "transmittance");
        EXPECT_EQ(row == 2, std::abs(found - 1) < 1e-6);
        EXPECT_EQ(row == 1, std::abs(a - b) > 1e-3);
    }
}

const std::string kSummedParts =
    "quantities = ['incident_upper_direct', 'sunlit_fraction_upper', 'sunlit_fraction', "
    "'incident_upper_sunlit', 'incident_upper_shaded', 'incident_lower_sunlit', "
    "'incident_lower_shaded', 'absorbed_flux_density_sunlit', 'absorbed_flux_density_shaded']\n";

/// Compares values with their errors. @param lit  where the sunlit fraction is
void expect_equal_parts(
    const std::vector<double>& found,
    const std::vector<double>& one,
    std::size_t lit,
    const std::string& row) {
    for (std::size_t i = 0; i < found.size(); ++i) {
        // An organ has light of a shaded part even if it has no shaded area.
        const bool is_void = std::isnan(found[i - i % 3]) && one[lit] > 1 - 1e-3;
        if (!is_void) {
            expect_near(found[i], one[i], row + " " + std::to_string(i));
        }
    }
}

/// Means of equal points are one of them, with its error: so are quotients of sums.
TEST(SweepTable, OfEqualPointsHasTheSunlitAndShadedPartsOfOne) {
    for (const std::string rows : {"organs", "groups"}) {
        const std::string keys = "rows = '" + rows + "'\nbands = ['R']\n" + kSummedParts;
        const auto texts = written(stand(
            "[sweep]\nmaterial.leaf.reflectance = [[0.1, 0.4], [0.1, 0.4]]\n"
            "weights = [1, 3]\n" +
            table("sum.csv", keys + "per = 'sweep'\n") + table("each.csv", keys)));
        const Rows sum = fields_of(texts[0]), each = fields_of(texts[1]);
        ASSERT_EQ(2 * (sum.size() - 1), each.size() - 1) << rows;
        const std::size_t first = sum[0].size() - 27;
        ASSERT_TRUE(std::equal(sum[0].begin(), sum[0].end(), each[0].begin() + 1));
        const auto found_lit = std::ranges::find(sum[0], "sunlit_fraction");
        const std::size_t lit = static_cast<std::size_t>(found_lit - sum[0].begin()) - first;
        int seen = 0;
        for (std::size_t row = 1; row < sum.size(); ++row) {
            const auto found = numbers_from(sum[row], first);
            const auto one = numbers_from(each[row], first + 1);
            expect_equal_parts(found, one, lit, rows + sum[row][1]);
            seen += found[lit] > 0 && found[lit] < 0.9 ? 1 : 0;
        }
        EXPECT_GT(seen, 0) << "partly lit";
    }
}

/// Light per sunlit area weighs each point by its sunlit area, light per shaded area by the rest.
TEST(SweepTable, WeighsSunlitAndShadedLightByTheirAreas) {
    for (const std::string rows : {"organs", "groups"}) {
        const std::string keys = "rows = '" + rows + "'\nbands = ['R']\n" + kSummedParts + kMeans;
        const auto texts = written(stand(
            "[sweep]\nsource.sun.direction = [[1, 0, -1], [0, 0.2, -1]]\n"
            "weights = [1, 2]\n" +
            table("sum.csv", keys + "per = 'sweep'\n") + table("each.csv", keys)));
        const Rows sum = fields_of(texts[0]), each = fields_of(texts[1]);
        const std::size_t first = sum[0].size() - 9;
        const auto column = [&](const std::string& name) {
            const auto found = std::ranges::find(sum[0], name);
            EXPECT_NE(found, sum[0].end()) << name;
            return static_cast<std::size_t>(found - sum[0].begin()) - first;
        };
        const std::size_t lit = column("sunlit_fraction_upper");
        const std::size_t sunlit = column("incident_upper_sunlit_R");
        const std::size_t shaded = column("incident_upper_shaded_R");
        int partly_lit = 0;
        for (std::size_t row = 1; row < sum.size(); ++row) {
            const auto found = numbers_from(sum[row], first);
            const auto a = numbers_from(each[row], first + 1);
            const auto b = numbers_from(each[row + sum.size() - 1], first + 1);
            const auto mean = [&](double weight_a, double weight_b, std::size_t i) {
                return (weight_a * (weight_a > 0 ? a[i] : 0) +
                        weight_b * (weight_b > 0 ? b[i] : 0)) /
                       (weight_a + weight_b);
            };
            expect_near(found[lit], mean(1, 2, lit), "sunlit_fraction_upper");
            if (std::max(a[lit], b[lit]) > 0.99) {
                continue;  // fractions end at 1, their samples do not
            }
            ++partly_lit;
            expect_near(found[sunlit], mean(a[lit], 2 * b[lit], sunlit), "sunlit " + rows);
            expect_near(found[shaded], mean(1 - a[lit], 2 - 2 * b[lit], shaded), "shaded " + rows);
        }
        EXPECT_GT(partly_lit, 0);
    }
}

/// Hours add up; light per sunlit area is its mean over area and time.
TEST(SweepTable, OfTimesHasSunlitHoursAndTheLightOfParts) {
    std::string quantities = kSummedParts;
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"sunlit_fraction_upper", "sunlit_hours_upper"},
             {"'sunlit_fraction'", "'sunlit_hours'"}}) {
        quantities.replace(quantities.find(from), from.size(), to);
    }
    for (const std::string rows : {"organs", "groups"}) {
        const std::string keys = "rows = '" + rows + "'\nbands = ['R']\n" + quantities + kMeans;
        const auto texts = written(stand(
            kHours +
            "[sweep]\ntime.day = ['2024-01-15', '2024-06-15']\n"
            "weights = [31, 30]\n" +
            table("sum.csv", keys + "per = 'sweep'\n") +
            table("each.csv", keys + "per = 'period'\n")));
        const Rows sum = fields_of(texts[0]), each = fields_of(texts[1]);
        ASSERT_EQ(each.size() - 1, 2 * (sum.size() - 1));
        const std::size_t first = sum[0].size() - 9;
        const auto column = [&](const std::string& name) {
            return static_cast<std::size_t>(std::ranges::find(sum[0], name) - sum[0].begin()) -
                   first;
        };
        const std::size_t hours = column("sunlit_hours"), upper = column("sunlit_hours_upper");
        const std::size_t sunlit = column("incident_upper_sunlit_R");
        const std::size_t shaded = column("incident_upper_shaded_R");
        const std::size_t direct = column("incident_upper_direct_R");
        int partly_lit = 0;
        for (std::size_t row = 1; row < sum.size(); ++row) {
            const auto found = numbers_from(sum[row], first);
            const auto a = numbers_from(each[row], first + 2);
            const auto b = numbers_from(each[row + sum.size() - 1], first + 2);
            for (const std::size_t i : {hours, upper, direct}) {
                expect_near(found[i] / 1000, (31 * a[i] + 30 * b[i]) / 1000, sum[0][first + i]);
            }
            if (std::max(a[upper], b[upper]) > 0.95 * 3) {
                continue;  // hours end at 3, their samples do not
            }
            ++partly_lit;
            const double lit_a = 31 * a[upper], lit_b = 30 * b[upper];
            const double shade_a = 31 * 3 - lit_a, shade_b = 30 * 3 - lit_b;
            const auto mean = [&](double weight_a, double weight_b, std::size_t i) {
                return (weight_a * a[i] + weight_b * b[i]) / (weight_a + weight_b);
            };
            expect_near(found[sunlit], mean(lit_a, lit_b, sunlit), "sunlit " + rows);
            expect_near(found[shaded], mean(shade_a, shade_b, shaded), "shaded " + rows);
        }
        EXPECT_GT(partly_lit, 0);
    }
}

/// A mean over points below the leaves, some of which are sunlit, and a point above them.
const std::string kPartlyLit =
    "[[sensors]]\nname = 'below'\naverage = true\n"
    "at = { start = [0, 0, 0.2], along = [2, 0, 0], across = [0, 2, 0], counts = [8, 8] }\n"
    "[[sensors]]\nname = 'above'\nat = [[0.5, 0.5, 5]]\n";

/// Means of equal points are one of them, with its error.
TEST(SweepTable, OfEqualPointsHasTheSunlitFractionOfSensors) {
    const std::string keys = "rows = 'sensors'\nquantities = ['sunlit_fraction']\n";
    const auto texts = written(stand(
        kPartlyLit +
        "[sweep]\nmaterial.leaf.reflectance = [[0.1, 0.4], [0.1, 0.4]]\nweights = [1, 3]\n" +
        table("sum.csv", keys + "per = 'sweep'\n") + table("each.csv", keys)));
    const Rows sum = fields_of(texts[0]), each = fields_of(texts[1]);
    ASSERT_EQ(sum.size(), 3U);
    for (const std::size_t row : {1, 2}) {
        const auto found = numbers_from(sum[row], sum[row].size() - 3);
        const auto one = numbers_from(each[row], each[row].size() - 3);
        for (std::size_t i = 0; i < found.size(); ++i) {
            expect_near(found[i], one[i], sum[row][1]);
        }
        EXPECT_EQ(row == 1, found[0] > 0.1 && found[0] < 0.9 && found[1] > 1e-3);
    }
}

/// Fractions are averaged by the weights of points, hours add up.
TEST(SweepTable, WeighsTheSunlitFractionsAndHoursOfSensors) {
    const auto check = [](const std::string& rest, const std::string& quantity,
                          const std::string& per, std::array<double, 2> weights, double hours) {
        const std::string keys = "rows = 'sensors'\nquantities = ['" + quantity + "']\n" + kMeans;
        const auto texts = written(stand(
            kPartlyLit + rest + table("sum.csv", keys + "per = 'sweep'\n") +
            table("each.csv", keys + per)));
        const Rows sum = fields_of(texts[0]), each = fields_of(texts[1]);
        ASSERT_EQ(sum.size(), 3U);
        ASSERT_EQ(each.size(), 5U);
        const double a = std::stod(each[1].back()), b = std::stod(each[3].back());
        expect_near(std::stod(sum[1].back()), weights[0] * a + weights[1] * b, quantity);
        EXPECT_GT(std::abs(a - b), 1e-2);
        const double all = std::accumulate(weights.begin(), weights.end(), 0.0) * hours;
        EXPECT_NEAR(std::stod(sum[2].back()), all, 1e-2 * all) << "above the leaves";
    };
    check(
        "[sweep]\nsource.sun.direction = [[1, 0, -1], [0, 0.2, -1]]\nweights = [1, 3]\n",
        "sunlit_fraction", "", {.25, .75}, 1);
    check(
        kHours + "[sweep]\ntime.day = ['2024-01-15', '2024-06-15']\nweights = [31, 30]\n",
        "sunlit_hours", "per = 'period'\n", {31, 30}, 3);
    EXPECT_TRUE(mentions(
        faults_of(stand(
            kPartlyLit + "[sweep]\npaths = [64, 128]\n" +
            table("sum.csv", "rows = 'sensors'\nper = 'sweep'\nquantities = ['sunlit_hours']\n"))),
        "quantities"));
}

/// Points share their random numbers: intervals over many seeds hold the mean of many paths.
TEST(SweepTable, HoldsTheSunlitFractionOfSensors) {
    constexpr int kSeeds = 200;
    const auto fraction = [](int paths, int seed) {
        std::string text = stand(
            kPartlyLit +
            "[sweep]\nsource.sun.direction = [[1, 0, -1], [1, 0.1, -1], [0, 0.8, -1], [0.2, 0.3, "
            "-1]]\nweights = [1, 2, 1, 3]\n" +
            table(
                "sum.csv",
                "rows = 'sensors'\nper = 'sweep'\nquantities = ['sunlit_fraction']\n"
                "where = \"name == 'below'\"\nstatistics = ['mean', 'se', 'ci95_low', "
                "'ci95_high']\n"));
        const std::string few = "paths = 256\n";
        text.replace(
            text.find(few), few.size(),
            "paths = " + std::to_string(paths) + "\nseed = " + std::to_string(seed) + "\n");
        const Rows sum = fields_of(written(text)[0]);
        return numbers_from(sum.at(1), sum[0].size() - 4);
    };
    const double truth = fraction(1 << 15, 12345)[0];
    int right = 0;
    double scatter = 0, variance = 0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
        const auto found = fraction(64, seed);
        right += found[2] <= truth && truth <= found[3] ? 1 : 0;
        scatter += (found[0] - truth) * (found[0] - truth);
        variance += found[1] * found[1];
    }
    EXPECT_GT(right, .9 * kSeeds);
    EXPECT_GT(std::sqrt(variance / scatter), .8);
    EXPECT_LT(std::sqrt(variance / scatter), 2);
}

/// Nothing is sunlit under a sky alone.
TEST(SweepTable, HasNoSunlitFractionWithoutASun) {
    std::string text = stand(
        "[sweep]\nmaterial.leaf.reflectance = [0.1, 0.2]\n" +
        table("sum.csv", "per = 'sweep'\nquantities = ['sunlit_fraction']\n" + kMeans));
    const std::string sun =
        "type = 'directional'\nname = 'sun'\ndirection = [1, 0, -1]\nirradiance_facing";
    text.replace(text.find(sun), sun.size(), "type = 'uniform_sky'\nirradiance_horizontal");
    const Rows sum = fields_of(written(text)[0]);
    ASSERT_EQ(sum.size(), 4U);
    for (std::size_t row = 1; row < sum.size(); ++row) {
        EXPECT_EQ(sum[row].back(), "0");
    }
}

TEST(SweepTable, HasRowsByConditionInLongForm) {
    const Rows rows = fields_of(written(stand(
        "[sweep]\npaths = [64, 128]\n" +
        table(
            "sum.csv",
            "per = 'sweep'\nform = 'long'\nwhere = 'plant == 2'\nbands = ['R']\n"
            "quantities = ['absorbed_flux']\n")))[0]);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[1][0], "2");
    EXPECT_EQ(rows[1][4] + " " + rows[1][5] + " " + rows[1][6], "absorbed_flux R W");
}

TEST(SweepTable, HasNoRowsWithoutAllPoints) {
    const std::string text =
        stand("[sweep]\npaths = [64, 128, 256]\n" + table("sum.csv", "per = 'sweep'\n"));
    EXPECT_EQ(fields_of(written(text)[0]).size(), 4U);
    EXPECT_EQ(fields_of(written(text, 2)[0]).size(), 1U);
}

}  // namespace
}  // namespace quasimc::test
