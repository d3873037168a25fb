#include "growth/language/preprocessor.h"

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "growth/language/condition.h"
#include "quasimc/error.h"

namespace quasimc::test {
namespace {

using TextFiles = std::map<std::string, std::string>;

/// The result of the preprocessor for files in memory; the first is read.
struct Preprocessed {
    PreprocessedText text;
    std::vector<std::string> warnings, faults;
};

Preprocessed run(const TextFiles& files) {
    Preprocessed result;
    const auto read = [&](const std::filesystem::path& path) {
        const auto found = files.find(path.lexically_relative("/m").string());
        if (found == files.end()) {
            throw InputError({{path.string(), "can't be read", "it is missing", ""}});
        }
        return found->second;
    };
    InputFiles input("/m", read);
    Notices notices([&](const std::string& text) { result.warnings.push_back(text); });
    try {
        result.text = preprocess("a.l", input, notices);
    } catch (const InputError& error) {
        for (const Fault& fault : error.faults()) {
            result.faults.push_back(fault.text());
        }
    }
    return result;
}

/// The text made from one file, without warnings.
std::string text_of(const std::string& source) {
    const Preprocessed result = run({{"a.l", source}});
    EXPECT_TRUE(result.faults.empty()) << result.faults.front();
    EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
    return result.text.text;
}

/// The only fault of a file.
std::string fault_of(const std::string& source) {
    const Preprocessed result = run({{"a.l", source}});
    EXPECT_EQ(result.faults.size(), 1U);
    return result.faults.empty() ? "" : result.faults.front();
}

std::string warning_of(const std::string& source) {
    const Preprocessed result = run({{"a.l", source}});
    EXPECT_TRUE(result.faults.empty()) << result.faults.front();
    EXPECT_EQ(result.warnings.size(), 1U);
    return result.warnings.empty() ? "" : result.warnings.front();
}

TEST(Preprocessor, RemovesCommentsAndKeepsLines) {
    EXPECT_EQ(text_of("a/* x */b // c\n/* 1\n2 */c\n\"/* // \"d"), "ab \n\nc\n\"/* // \"d\n");
    EXPECT_EQ(text_of("a /*/ b */ c\n"), "a  c\n");
    EXPECT_EQ(text_of("\"open // text\nA // b\n"), "\"open // text\nA \n");
}

TEST(Preprocessor, JoinsLinesAndDropsCarriageReturns) {
    EXPECT_EQ(text_of("a \\\n\tb\r\nc \\\r\nd\\x\re\n"), "a \tb\nc d\\x\re\n");
    EXPECT_EQ(text_of("a\\"), "a\\\n");
    EXPECT_EQ(text_of(""), "");
}

TEST(Preprocessor, NamesTheSourceOfEachLine) {
    const Preprocessed result = run(
        {{"a.l", "one\n#include \"sub/b.h\"\ntwo \\\nthree\n# 12 \"c.l\"\nfour\n"},
         {"sub/b.h", "six\n#include \"c.h\"\n"},
         {"sub/c.h", "seven"}});
    const std::vector<std::string> expected = {"a.l:1", "sub/b.h:1", "sub/c.h:1", "sub/b.h:2",
                                               "a.l:2", "a.l:3",     "a.l:5",     "a.l:6"};
    EXPECT_EQ(result.text.text, "one\nsix\nseven\n\n\ntwo three\n\nfour\n");
    ASSERT_EQ(result.text.lines.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(result.text.where(i), expected[i]);
    }
    EXPECT_EQ(result.text.where(1000), "a.l:6");
}

TEST(Preprocessor, ExpandsWholeNamesOnlyWithATrailingBlank) {
    EXPECT_EQ(
        text_of("#define X 5 /* five */\nX XY !X #(X) \\X 2X X_ \"X\" FX+X\n"),
        "\n5  XY !5  #(5 ) \\5  2X X_ \"X\" FX+5 \n");
}

/// Case 65 of the recorded runs of cpfg.
TEST(Preprocessor, ExpandsMacrosInModules) {
    EXPECT_EQ(
        text_of("#define LEAF(a) [+(a)~l(1)]\n#define BOTH(a,b) LEAF(a)LEAF(-(b))\n"
                "I(n)BOTH(n*10,30)A(n+1)\n"),
        "\n\nI(n)[+(n*10)~l(1)] [+(-(30))~l(1)]  A(n+1)\n");
}

TEST(Preprocessor, ExpandsArguments) {
    const std::string two = "#define SQ(x) ((x)*(x))\n#define P(a, b) a;b\n";
    EXPECT_EQ(text_of(two + "SQ(SQ(2))\n"), "\n\n((((2)*(2)) )*(((2)*(2)) )) \n");
    EXPECT_EQ(text_of(two + "P( (1,2) , \"),\" )\n"), "\n\n(1,2);\"),\" \n");
    EXPECT_EQ(text_of(two + "SQ SQ  (3) SQ\n(4)\n"), "\n\nSQ ((3)*(3))  SQ\n(4)\n");
    EXPECT_EQ(text_of("#define CALL(f) f(2)\n" + two + "CALL(SQ)\n"), "\n\n\n((2)*(2))  \n");
    EXPECT_EQ(text_of("#define G SQ\n" + two + "G(3)\n"), "\n\n\n((3)*(3)) \n");
    EXPECT_EQ(text_of("#define N() 1\n#define E(x) [x]\nN() E()\n"), "\n\n1  [] \n");
    EXPECT_EQ(text_of("#define L(x) x \"x\" ax\nL(1)\n"), "\n1 \"x\" ax \n");
}

TEST(Preprocessor, ReadsArgumentsOverLines) {
    const Preprocessed result = run({{"a.l", "#define P(a,b) a;b\nP(1,\n\t2)c\nd\n"}});
    EXPECT_EQ(result.text.text, "\n1;2 c\nd\n");
    EXPECT_EQ(result.text.where(2), "a.l:4");
}

TEST(Preprocessor, DoesNotExpandAMacroWithinItself) {
    EXPECT_EQ(text_of("#define F F(1)\nF\n"), "\nF(1) \n");
    EXPECT_EQ(text_of("#define A B+A\n#define B A-B\nA\n"), "\n\nA-B +A \n");
    EXPECT_EQ(text_of("#define F F(1)\n#define ID(x) x\nID(F)\n"), "\n\nF(1)  \n");
}

TEST(Preprocessor, SelectsLines) {
    const std::string source =
        "#define N 3\n#if N > 2 && defined(N) && !defined M\na\n#elif 1/0\nb\n#else\nc\n#endif\n"
        "#ifndef N\n#if 1\nd\n#else\ne\n#endif\n#else\nf\n#endif\n#undef N\n#ifdef N\ng\n#endif\n";
    EXPECT_EQ(text_of(source), "\n\na\n\n\n\n\n\n\n\n\n\n\n\n\nf\n\n\n\n\n\n");
}

TEST(Preprocessor, WarnsAboutGroupsThatAreNotClosed) {
    EXPECT_EQ(warning_of("x\n#if 0\ny\n"), "a.l:2: the #if has no #endif");
    EXPECT_EQ(warning_of("#endif\n"), "a.l:1: #endif has no #if: it is ignored");
    EXPECT_EQ(text_of("#if 0\n#else\na\n#else\nb\n#endif\n"), "\n\na\n\n\n\n");
}

TEST(Preprocessor, WarnsAboutMacros) {
    EXPECT_EQ(text_of("#define A 1\n#define A   1 \n"), "\n\n");
    EXPECT_EQ(warning_of("#define A 1\n#define A 2\nA\n"), "a.l:2: the macro 'A' is defined again");
    EXPECT_EQ(
        warning_of("#define P(a,b) a;b\nP(1)\n"),
        "a.l:2: a macro with 2 parameters has 1 argument");
}

TEST(Preprocessor, KeepsTheSymbolNumberSign) {
    EXPECT_EQ(
        text_of("#(2)F\n\t#F\n\t#\n#\n  #define A 1\n\t#if\tA\nA\n #endif\n"),
        "#(2)F\n\t#F\n\t#\n\n\n\n1 \n\n");
    const Preprocessed result = run({{"a.l", "#F(x) --> A\n"}});
    EXPECT_EQ(result.text.text, "#F(x) --> A\n");
    ASSERT_EQ(result.warnings.size(), 1U);
}

TEST(Preprocessor, WarnsAboutMissingIncludedFiles) {
    EXPECT_EQ(
        warning_of("#include <none.h>\nx\n"),
        "a.l:1: #include is ignored: /m/none.h: can't be read (it is missing)");
    const Preprocessed result =
        run({{"a.l", "#define H <b.h>\n#include H\n#include \"b.h\" x\n"}, {"b.h", "b"}});
    EXPECT_EQ(result.text.text, "\nb\n\nb\n\n");
}

TEST(Preprocessor, RefusesWhatIsWrong) {
    EXPECT_NE(fault_of("\n/* x\n\n"), "");
    EXPECT_EQ(fault_of("\n/* x\n\n").substr(0, 6), "a.l:2:");
    EXPECT_NE(fault_of("#define A(x) x\nA(1\n\n"), "");
    EXPECT_NE(fault_of("#define A(x) x\nA(1\n#define B\n)\n"), "");
    EXPECT_NE(fault_of("#define A(x x\n"), "");
    EXPECT_NE(fault_of("#define A(x,x) x\n"), "");
    EXPECT_NE(fault_of("#define 3\n"), "");
    EXPECT_NE(fault_of("#if 1.5\n#endif\n"), "");
    EXPECT_NE(fault_of("#if defined(\n#endif\n"), "");
    EXPECT_NE(fault_of("#ifdef\n#endif\n"), "");
    EXPECT_NE(fault_of("#include x\n"), "");
    EXPECT_NE(fault_of("#error bad\n"), "");
    EXPECT_EQ(run({}).faults.size(), 1U);
    EXPECT_EQ(run({{"a.l", "#error 1\n#if\n#endif\n/*"}}).faults.size(), 3U);
}

TEST(Preprocessor, LimitsNesting) {
    EXPECT_NE(fault_of("#include \"a.l\"\n#include \"a.l\"\n"), "");
    std::string chain;
    for (int i = 0; i < 300; ++i) {
        chain += "#define A" + std::to_string(i) + " A" + std::to_string(i + 1) + "\n";
    }
    EXPECT_NE(fault_of(chain + "A0\n"), "");
    std::string nested = "#define L(x) x\n";
    for (int i = 0; i < 20'000; ++i) {
        nested += "L(";
    }
    EXPECT_NE(fault_of(nested + std::string(20'000, ')')), "");
}

TEST(Preprocessor, LimitsTheText) {
    std::string doubled;
    std::string empty;
    for (int i = 0; i < 40; ++i) {
        const std::string next = std::to_string(i + 1);
        doubled += "#define A" + std::to_string(i) + " A" + next + " A" + next + "\n";
        empty += "#define A" + std::to_string(i) + "(x) A" + next + "()A" + next + "()\n";
    }
    EXPECT_NE(fault_of(doubled + "A0\n"), "");
    EXPECT_NE(fault_of(empty + "A0()\n"), "");
    TextFiles files;
    for (char c = 'a'; c < 'z'; ++c) {
        const std::string line = std::string("#include \"") + char(c + 1) + ".l\"\n";
        files[std::string(1, c) + ".l"] = line + line;
    }
    files["z.l"] = "";
    EXPECT_EQ(run(files).faults.size(), 1U);
}

TEST(Condition, HasTheOperatorsOfC) {
    EXPECT_EQ(evaluate_condition("1 + 2 * 3 == 7 && 7 % 4 == 3").value, 1);
    EXPECT_EQ(evaluate_condition("- - 2 - -+3").value, 5);
    EXPECT_EQ(evaluate_condition("!name || 1 / 0").value, 1);
    EXPECT_EQ(evaluate_condition("0 && (1 % 0 || 2)").value, 0);
    EXPECT_EQ(evaluate_condition("10 - 3 - 2").value, 5);
    EXPECT_EQ(evaluate_condition("(-9223372036854775807 - 1) / -1").problem, "");
    EXPECT_EQ(evaluate_condition("5 >= 5 != 4 <= 3").value, 1);
}

TEST(Condition, ReportsProblems) {
    for (const char* text :
         {"", "1 +", "(1", "1)", "1 2", "1 / 0", "1.5", "0x1", "1 ? 2", "\"a\"",
          "99999999999999999999", "1 && 3 / 0", "f(2)"}) {
        EXPECT_NE(evaluate_condition(text).problem, "") << text;
    }
    EXPECT_NE(evaluate_condition(std::string(100'000, '(')).problem, "");
    EXPECT_NE(evaluate_condition(std::string(100'000, '!') + "1").problem, "");
}

}  // namespace
}  // namespace quasimc::test
