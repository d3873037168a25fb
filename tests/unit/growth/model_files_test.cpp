#include "growth/language/model_files.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "growth/language/format_values.h"
#include "support/temporary_folder.h"

namespace quasimc::test {
namespace {

std::string formatted(std::string_view format, const std::vector<double>& values = {}) {
    return format_values(format, values).text;
}

/// Case 75 of the recorded runs of cpfg.
TEST(FormatValues, PrintsAsCpfg) {
    EXPECT_EQ(
        formatted("> A %5.2f|%e|%g%%\n", {1.5, 1500, 0.375}), "> A  1.50|1.500000e+03|0.375%\n");
    EXPECT_EQ(formatted("> %g %g %g %g\n", {1.5, 2, -3, -1}), "> 1.5 2 -3 -1\n");
}

TEST(FormatValues, FormatsAsPrintf) {
    const double values[] = {0,    -0.0,   1,       -1,      0.1,  1.0 / 3,  123456,    1234567,
                             1e10, 1e-5,   9.99995, 2.5,     1e99, 1e308,    5e-324,    -7.25,
                             1e15, 0.0001, 1e100,   -1e-300, NAN,  INFINITY, -INFINITY, 99999.95};
    const char* formats[] = {"%g",    "%f",    "%e",   "%G",    "%E",      "%8.3f", "%-12g|", "%+g",
                             "% .2e", "%012g", "%.0f", "%.12g", "%.0e",    "%5g",   "%lf",    "%.g",
                             "%F",    "%a",    "%.3a", "%A",    "%-+9.2f", "%09.3f"};
    for (const char* format : formats) {
        for (const double value : values) {
            char expected[2000];
            std::snprintf(expected, sizeof expected, format, value);
            EXPECT_EQ(formatted(format, {value}), expected) << format;
        }
    }
}

TEST(FormatValues, PrintsTruncatedIntegers) {
    EXPECT_EQ(
        formatted("%d %i %u %x %X %o %c", {2.9, -2.9, 7, 255.5, 255, 8, 65}), "2 -2 7 ff FF 10 65");
    EXPECT_EQ(
        formatted("[%5d] [%-5d] [%05d] [%+d] [%.3d]", {42, 42, -42, 42, 7}),
        "[   42] [42   ] [-0042] [+42] [007]");
    EXPECT_EQ(
        formatted("%ld %d %d %#x", {1e18, -0.5, 1e20, 16}),
        "1000000000000000000 0 100000000000000000000 0x10");
    EXPECT_EQ(formatted("%d %x", {NAN, -INFINITY}), "nan -inf");
}

TEST(FormatValues, ReportsMissingValues) {
    const FormattedText result = format_values("%g %g %g", std::vector<double>{1});
    EXPECT_EQ(result.text, "1 0 0");
    EXPECT_EQ(result.problems.size(), 1U);
}

TEST(FormatValues, RefusesStringsAndAddresses) {
    const FormattedText result = format_values("a%sb%nc%pd%g", std::vector<double>{1, 2, 3, 4});
    EXPECT_EQ(result.text, "abcd4");
    EXPECT_EQ(result.problems.size(), 3U);
}

TEST(FormatValues, KeepsWhatIsNoConversion) {
    EXPECT_EQ(formatted("100%"), "100%");
    EXPECT_EQ(formatted("%y %-5.3 k %", {1}), "%y %-5.3 k %");
    EXPECT_EQ(formatted("%*g|%g", {5, 1}), "%*g|5");
}

TEST(FormatValues, LimitsWidths) {
    EXPECT_EQ(formatted("%99999999999999g", {1}).size(), 1000U);
    EXPECT_EQ(formatted("%.99999999999f", {0.5}).size(), 1002U);
    EXPECT_GT(formatted("%.1000f", {-1e308}).size(), 1300U);
    std::string many;
    for (int i = 0; i < 2000; ++i) {
        many += "%1000g";
    }
    const FormattedText result = format_values(many, std::vector<double>(2000));
    EXPECT_EQ(result.text.size(), 1U << 20U);
    EXPECT_EQ(result.problems.size(), 1U);
}

class ModelFilesTest : public FolderTest {};

TEST_F(ModelFilesTest, ReadsWhatItWrote) {
    ModelFiles files(folder_.path());
    const double out = files.open("a.tmp", "w");
    EXPECT_EQ(out, 0);
    EXPECT_EQ(files.write(out, "1.5 2\n-3\n"), 9);
    EXPECT_EQ(files.close(out), 0);
    const double in = files.open("a.tmp", "r");
    EXPECT_EQ(in, 0);
    const ScannedValues two = files.scan(in, "%lf %lf");
    ASSERT_EQ(two.values.size(), 2U);
    EXPECT_EQ(two.values[0], 1.5);
    EXPECT_EQ(two.values[1], 2);
    EXPECT_EQ(files.scan(in, "%lf").values[0], -3);
    EXPECT_FALSE(files.scan(in, "%lf").values[0].has_value());
    EXPECT_EQ(files.write(in, "x"), -1);
    EXPECT_EQ(files.close(in), 0);
    EXPECT_EQ(files.close(in), -1);
}

TEST_F(ModelFilesTest, WritesWhatIsFlushedAndTheOthersAtItsEnd) {
    {
        ModelFiles files(folder_.path());
        const double first = files.open("a", "w");
        const double second = files.open("b", "a");
        EXPECT_EQ(second, 1);
        files.write(first, "one");
        files.write(second, "two");
        EXPECT_EQ(files.flush(first), 0);
        EXPECT_EQ(folder_.read("a"), "one");
        EXPECT_EQ(files.flush(7), -1);
    }
    EXPECT_EQ(folder_.read("b"), "two");
}

TEST_F(ModelFilesTest, ReadsAndWritesAFileInTurn) {
    folder_.write("a", "12 34\n");
    ModelFiles files(folder_.path());
    const double file = files.open("a", "r+");
    EXPECT_EQ(files.scan(file, "%d").values[0], 12);
    EXPECT_EQ(files.write(file, "x5"), 2);
    EXPECT_FALSE(files.scan(file, "x%d").values[0].has_value());
    EXPECT_EQ(files.scan(file, "%d").values[0], 4);
    files.close(file);
    EXPECT_EQ(folder_.read("a"), "12x54\n");
}

TEST_F(ModelFilesTest, RefusesFoldersPipesDevicesAndOddModes) {
    ModelFiles files(folder_.path());
    ASSERT_EQ(::mkfifo((folder_.path() / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(files.open("none", "r"), -1);
    EXPECT_EQ(files.open("pipe", "r"), -1);
    EXPECT_EQ(files.open(".", "r"), -1);
    EXPECT_EQ(files.open("/dev/null", "w"), -1);
    EXPECT_EQ(files.open("", "w"), -1);
    EXPECT_EQ(files.open(std::string("a\0b", 3), "w"), -1);
    for (const char* mode : {"", "x", "rw", "wx", "w+bt", "r,ccs=UTF-8"}) {
        EXPECT_EQ(files.open("a", mode), -1) << mode;
    }
}

TEST_F(ModelFilesTest, LimitsOpenFiles) {
    ModelFiles files(folder_.path());
    for (std::size_t i = 0; i < ModelFiles::kMaxFiles; ++i) {
        EXPECT_EQ(files.open("a", "a"), static_cast<double>(i));
    }
    EXPECT_EQ(files.open("a", "a"), -1);
    EXPECT_EQ(files.close(5), 0);
    EXPECT_EQ(files.open("a", "a"), 5);
    EXPECT_EQ(ModelFiles(folder_.path(), 0).open("a", "r"), -1);
    for (const double odd : {-1.0, 64.0, 1e300, double(NAN), double(INFINITY)}) {
        EXPECT_EQ(files.close(odd), -1);
        EXPECT_FALSE(files.is_open(odd));
    }
}

TEST_F(ModelFilesTest, ScansFormats) {
    folder_.write("a", "x = 1.5, y=-2e3;%7 12345 .5 5. inf nan word 9\n");
    ModelFiles files(folder_.path());
    const double file = files.open("a", "r");
    const ScannedValues line = files.scan(file, "x =%lf , y=%f;%%%*d %2d%3d %g %le %lf%lf %*s %i");
    const double expected[] = {1.5, -2000, 12, 345, 0.5, 5, INFINITY, NAN, 9};
    ASSERT_EQ(line.values.size(), 9U);
    for (std::size_t i = 0; i < 9; ++i) {
        ASSERT_TRUE(line.values[i].has_value()) << i;
        EXPECT_TRUE(*line.values[i] == expected[i] || std::isnan(expected[i])) << i;
    }
    EXPECT_TRUE(line.problems.empty());
}

TEST_F(ModelFilesTest, StopsWhereAFormatDoesNotMatch) {
    folder_.write("a", "1 x 2");
    ModelFiles files(folder_.path());
    const double file = files.open("a", "r");
    const ScannedValues numbers = files.scan(file, "%lf y %lf %s");
    ASSERT_EQ(numbers.values.size(), 3U);
    EXPECT_EQ(numbers.values[0], 1);
    EXPECT_FALSE(numbers.values[1].has_value());
    EXPECT_EQ(numbers.problems.size(), 1U);
    EXPECT_EQ(files.scan(file, "x%lf").values[0], 2);
    for (const char* odd : {"%", "%5%", "%*%", "%[a]", "%n", "%*", "%%%"}) {
        static_cast<void>(files.scan(file, odd));
    }
    EXPECT_EQ(files.scan(99, "%lf%lf").values.size(), 2U);
}

}  // namespace
}  // namespace quasimc::test
