#include <array>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "growing.h"

namespace quasimc::test {
namespace {

/// Writes random models of cpfg's language that are correct.
class ModelGenerator {
  public:
    explicit ModelGenerator(unsigned seed) : random_(seed) {}

    std::string model() {
        std::string text = "Lsystem: 1\n";
        text += maybe(4) ? "ring lsystem\n" : "";
        text += maybe(3) ? "seed: 5\n" : "";
        text += fmt::format("derivation length: {}\n", 1 + below(4));
        text += maybe(2) ? "ignore: +-/F\n" : maybe(3) ? "consider: ABC\n" : "";
        text += "define: { array t[3] = {1,2,0.5}; }\n";
        text += "Start: {srand(3); g=1; h=0;}\n";
        text += maybe(2) ? "StartEach: {" + statements() + "}\n" : "";
        text += maybe(3) ? "EndEach: {" + statements() + "}\n" : "";
        names_ = {"g", "h"};
        text += "axiom: " + modules(3) + "\n" + productions();
        text += maybe(2) ? "decomposition: no warnings\nmaximum depth: 2\n" + productions() : "";
        text += maybe(2) ? "homomorphism: no warnings\nmaximum depth: 3\n" + productions() : "";
        return text + "endlsystem\n";
    }

    /// Modules with expressions as parameters; branches are closed.
    std::string modules(int depth) {
        std::string text;
        for (unsigned i = 0, count = 1 + below(4); i < count; ++i) {
            text += maybe(4) && depth > 0 ? "[" + modules(depth - 1) + "]" : module();
        }
        return text;
    }

  private:
    unsigned below(unsigned n) { return static_cast<unsigned>(random_() % n); }
    bool maybe(unsigned n) { return below(n) == 0; }
    template <std::size_t kCount>
    const char* one_of(const std::array<const char*, kCount>& choices) {
        return choices[below(kCount)];
    }

    std::string module() {
        static constexpr std::array kSymbols{"A",  "B",  "C",  "A", "B",   "C",   "F",  "f",
                                             "G",  "+",  "-",  "/", "&",   "|",   "!",  "#",
                                             ";",  ",",  ".",  "{", "}",   "%",   "?P", "?E",
                                             "@O", "@c", "~l", "_", "@Gs", "@Ge", "@D", "$"};
        std::string text = one_of(kSymbols);
        const unsigned count = below(3);
        for (unsigned i = 0; i < count; ++i) {
            text += (i == 0 ? "(" : ",") + expression(2);
        }
        return text + (count > 0 ? ")" : "");
    }

    std::string expression(int depth) {
        static constexpr std::array kOperators{"+",  "-", "*",  "/",  "%",  "^",  "<",
                                               "<=", ">", ">=", "==", "!=", "&&", "||"};
        static constexpr std::array kFunctions{"sin", "cos",  "floor", "fabs",
                                               "ran", "sqrt", "sign"};
        switch (depth > 0 ? below(8) : below(3)) {
            case 0:
                return names_.empty() ? "2" : names_[below(static_cast<unsigned>(names_.size()))];
            case 1:
                return fmt::format("{}", below(10));
            case 2:
                return fmt::format("{}.{}", below(3), below(100));
            case 3:
                return "(" + expression(depth - 1) + "?" + expression(depth - 1) + ":" +
                       expression(depth - 1) + ")";
            case 4:
                return one_of(kFunctions) + ("(" + expression(depth - 1) + ")");
            case 5:
                return "t[" + expression(depth - 1) + "]";
            case 6:
                return "-(" + expression(depth - 1) + ")";
            default:
                return "(" + expression(depth - 1) + one_of(kOperators) + expression(depth - 1) +
                       ")";
        }
    }

    std::string statements() {
        std::string text = maybe(2) ? "g=" : "h=";
        text += expression(2) + ";";
        if (maybe(2)) {
            text += "if (" + expression(1) + ") {t[g]=" + expression(1) + ";} else {h=h+1;}";
        }
        return text + (maybe(3) ? "i=0; while (i<3) {i=i+1; h=h+i;}" : "");
    }

    /// A module of a predecessor or context; its parameters get names.
    std::string pattern() {
        static constexpr std::array kSymbols{"A", "B", "C"};
        std::string text = one_of(kSymbols);
        const unsigned count = below(3);
        for (unsigned i = 0; i < count; ++i) {
            names_.push_back("p" + std::to_string(names_.size()));
            text += (i == 0 ? "(" : ",") + names_.back();
        }
        return text + (count > 0 ? ")" : "");
    }

    std::string productions() {
        std::string text;
        for (unsigned i = 0, count = 1 + below(5); i < count; ++i) {
            names_ = {"g", "h"};
            text += maybe(4) ? pattern() + " < " : "";
            text += pattern();
            text += maybe(4) ? " > " + (maybe(3) ? "[" + pattern() + "]" : "") + pattern() : "";
            if (maybe(2)) {
                text += " : " + (maybe(3) ? "{" + statements() + "} " : "");
                text += maybe(3) ? "*" : expression(2);
                text += maybe(3) ? " {" + statements() + "}" : "";
            }
            text += " --> " + (maybe(8) ? "*" : modules(1)) + (maybe(5) ? " : 0.5" : "") + "\n";
        }
        return text;
    }

    std::mt19937 random_;
    std::vector<std::string> names_;
};

constexpr unsigned kModels = 200;

Grown grow_generated(const std::string& model) {
    GrowthOptions options;
    options.limits = {1 << 20, 10000};
    return grow(model, "angle increment: 30\ntropism: T: 0,-1,0 E: 0.1\n", nullptr, options);
}

TEST(GeneratedPlants, AreCorrectAndTheSameAgain) {
    unsigned grown_to_the_end = 0;
    for (unsigned seed = 0; seed < kModels; ++seed) {
        const std::string model = ModelGenerator(seed).model();
        ASSERT_EQ(model, ModelGenerator(seed).model());
        const Grown grown = grow_generated(model);
        const Grown again = grow_generated(model);
        EXPECT_EQ(grown.text, again.text) << model;
        EXPECT_EQ(grown.image, again.image) << model;
        EXPECT_EQ(grown.geometry, again.geometry) << model;
        EXPECT_EQ(grown.notices, again.notices) << model;
        EXPECT_EQ(grown.faults, again.faults) << model;
        grown_to_the_end += grown.faults.empty() ? 1 : 0;
        for (const std::string& fault : grown.faults) {
            EXPECT_NE(fault.find(" more than "), std::string::npos) << fault << "\n" << model;
        }
    }
    EXPECT_GT(grown_to_the_end, kModels * 9 / 10);
}

TEST(GeneratedPlants, HaveTextsThatAreAxioms) {
    for (unsigned seed = 0; seed < kModels; ++seed) {
        const std::string text = grow_generated(ModelGenerator(seed).model()).text;
        if (text.size() > 100'000 || text.find("nan") != std::string::npos ||
            text.find("inf") != std::string::npos || text.find("%(") != std::string::npos ||
            text.find("?P") != std::string::npos || text.find('e') != std::string::npos) {
            continue;  // these values can't be written, or change
        }
        std::string axiom = text;
        for (auto at = axiom.find("//"); at != std::string::npos; at = axiom.find("//")) {
            axiom.replace(at, 2, "/ /");  // no comment
        }
        EXPECT_EQ(grow(lsystem(0, axiom, "\n")).text, text) << text;
    }
}

TEST(GeneratedPlants, WithoutAPartAreCorrectOrFaulty) {
    for (unsigned seed = 0; seed < kModels; ++seed) {
        std::string model = ModelGenerator(seed).model();
        std::mt19937 random(seed);
        const std::size_t length = 1 + random() % 3;
        model.erase(random() % (model.size() - length), length);
        const Grown grown = grow_generated(model);
        EXPECT_TRUE(!grown.faults.empty() || grown.steps >= 0);
    }
}

}  // namespace
}  // namespace quasimc::test
