// Lists of types that name themselves, and what follows from them.
#include "kernels/math/alternatives.hpp"

#include <gtest/gtest.h>

#include <set>

#include "kernels/math/one_of.hpp"
#include "src/base/enum_names.hpp"
#include "src/case/config.hpp"

namespace barchan {
namespace {

struct Plain {
  static constexpr Named named{"plain", "without a number"};
  static constexpr double value() { return 7; }
};
struct Numbered {
  static constexpr Named named{"numbered", "of what is given"};
  double given = 0;
  static Numbered from(double given) { return {given}; }
  double value() const { return given; }
};
using Both = Alternatives<Plain, Numbered>;

TEST(Alternatives, WordsPlacesAndMakersFollowFromTheList) {
  EXPECT_EQ(Both::words[0], "plain");
  EXPECT_EQ(Both::named[1].meaning, "of what is given");
  const auto choice = Choice<Both>::of<Numbered>();
  EXPECT_TRUE(choice.is<Numbered>());
  EXPECT_FALSE(choice.is<Plain>());
  EXPECT_EQ(choice.word(), "numbered");
  EXPECT_NE(choice, Choice<Both>());
  EXPECT_EQ(Choice<Both>::all().size(), 2u);
  const auto made = Both::make(choice, 3.0);
  EXPECT_EQ(std::get<Numbered>(made).given, 3);
  EXPECT_TRUE(std::holds_alternative<Plain>(Both::make(Choice<Both>(), 3.0)));
}

TEST(Alternatives, OneOfIsWhatItWasMadeOf) {
  const auto value = [](const auto& it) { return it.value(); };
  const OneOf<Both> a{Numbered{5}}, b = a;
  EXPECT_EQ(b.visit(value), 5);
  EXPECT_EQ(OneOf<Both>().visit(value), 7);
  static_assert(std::is_trivially_copyable_v<OneOf<Both>>);
}

template <class List>
void expect_distinct_words() {
  const std::set<std::string_view> words(List::words.begin(), List::words.end());
  EXPECT_EQ(words.size(), List::size);
  for (const Named& one : List::named) {
    EXPECT_FALSE(one.word.empty());
    EXPECT_FALSE(one.meaning.empty()) << one.word;
  }
}

TEST(Alternatives, OfACaseHaveDistinctWordsAndMeanings) {
  expect_distinct_words<BodyShapes>();
  expect_distinct_words<ContactModels>();
  expect_distinct_words<DragLaws>();
  expect_distinct_words<Preconditioners>();
  expect_distinct_words<RollingModels>();
  expect_distinct_words<StartFlows>();
}

enum class Few { one, other };

TEST(EnumNames, AreTheEnumerators) {
  static_assert(kEnumNames<Few>.size() == 2);
  EXPECT_EQ(kEnumNames<Few>[0], "one");
  EXPECT_EQ(kEnumNames<Few>[1], "other");
  EXPECT_EQ(kEnumNames<GrainBoundaryX>.size(), 4u);
  EXPECT_EQ(kEnumNames<GrainBoundaryX>[3], "follow");
}

// A law that attracts is in contact, and looked for, as far as it reaches.
struct Sticky {
  Real range = 0;
  Real reach(Real r_eff) const { return range * r_eff; }
};

TEST(ContactRange, IsThatOfTheLaw) {
  const HertzMindlin hertz{.e_eff = 1e6, .g_eff = 1e6};
  EXPECT_EQ(reach(hertz, 1e-4), 0);
  EXPECT_TRUE(in_contact(hertz, 1e-4, 1e-9));
  EXPECT_FALSE(in_contact(hertz, 1e-4, 0));
  const Sticky sticky{.range = 0.01};
  EXPECT_DOUBLE_EQ(reach(sticky, 1e-4), 1e-6);
  EXPECT_TRUE(in_contact(sticky, 1e-4, -0.9e-6));
  EXPECT_FALSE(in_contact(sticky, 1e-4, -1.1e-6));
}

}  // namespace
}  // namespace barchan
