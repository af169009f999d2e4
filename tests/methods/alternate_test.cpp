#include "alternate.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>

#include "swage/error.h"

namespace swage {
namespace {

/// Passes with these energies, each moving one vertex by these lengths.
struct Script {
  std::vector<double> energies;
  std::vector<double> movements;
  int passes = 0;
  int fits = 0;

  Alternation steps() {
    return {[this](Positions& positions, const Poll&) {
              positions(0, 0) += movements[static_cast<size_t>(passes)];
              return energies[static_cast<size_t>(passes++)];
            },
            [this](const Positions&, const Poll&) { ++fits; }};
  }
};

Positions origin() { return Positions::Zero(1, 3); }

TEST(Alternate, StopsWhereTheEnergyRisesAndKeepsTheBetter) {
  Script script{{5, 9, 4, 4.5}, {1, 1, 1, 1}};
  Positions positions = origin();
  const Report report = alternate({}, {}, positions, script.steps());
  EXPECT_EQ(report.stop, Termination::energy_rose);
  EXPECT_EQ(report.passes, 4);
  EXPECT_EQ(report.best_pass, 2);
  EXPECT_EQ(report.energy, 4);
  EXPECT_EQ(positions(0, 0), 3);
  EXPECT_EQ(script.fits, 3);
}

TEST(Alternate, AnEnergyThatStandsStillHasRisen) {
  Script script{{5, 4, 4}, {1, 1, 1}};
  Positions positions = origin();
  EXPECT_EQ(alternate({}, {}, positions, script.steps()).stop, Termination::energy_rose);
}

TEST(Alternate, StopsWhereTheEnergySettles) {
  StopRule stop;
  stop.energy_drop = 0.5;
  Script script{{9, 8.9, 7, 6.6}, {1, 1, 1, 1}};
  Positions positions = origin();
  const Report report = alternate(stop, {}, positions, script.steps());
  EXPECT_EQ(report.stop, Termination::energy_settled);
  EXPECT_EQ(report.best_pass, 3);
  EXPECT_EQ(positions(0, 0), 4);
}

TEST(Alternate, StopsWhereNothingMoves) {
  StopRule stop;
  stop.movement = 0.1;
  Script script{{9, 8, 7, 6}, {0.01, 0.01, 0.2, 0.05}};
  Positions positions = origin();
  const Report report = alternate(stop, {}, positions, script.steps());
  EXPECT_EQ(report.stop, Termination::moved_little);
  EXPECT_EQ(report.passes, 4);
  EXPECT_NEAR(report.movements.back(), 0.05, 1e-15);
}

TEST(Alternate, StopsAtThePassLimitEvenBeforeTheFirstTest) {
  StopRule stop;
  stop.pass_limit = 2;
  Script script{{9, 10}, {1, 1}};
  Positions positions = origin();
  const Report report = alternate(stop, {}, positions, script.steps());
  EXPECT_EQ(report.stop, Termination::pass_limit);
  EXPECT_EQ(report.passes, 2);
}

TEST(Alternate, ACancelKeepsTheLastCompletePass) {
  Script script{{9, 8, 7}, {1, 1, 1}};
  Positions positions = origin();
  const Report report = alternate(
      {}, [](const Progress& p) { return p.pass < 2; }, positions, script.steps());
  EXPECT_EQ(report.stop, Termination::cancelled);
  EXPECT_EQ(report.passes, 2);
  EXPECT_EQ(positions(0, 0), 2);
}

TEST(Alternate, ACancelWithinAStepKeepsTheLastCompletePass) {
  for (const bool while_placing : {true, false}) {
    Script script{{9, 8, 7}, {1, 1, 1}};
    Alternation steps = script.steps();
    if (while_placing) {
      steps.place = [&, place = steps.place](Positions& positions, const Poll& poll) {
        const double energy = place(positions, poll);
        if (script.passes == 3) throw Cancelled();
        return energy;
      };
    } else {
      steps.fit = [&](const Positions&, const Poll&) {
        if (script.passes == 2) throw Cancelled();
      };
    }
    Positions positions = origin();
    const Report report = alternate({}, {}, positions, steps);
    EXPECT_EQ(report.stop, Termination::cancelled);
    EXPECT_EQ(report.passes, 2);
    EXPECT_EQ(report.energies, (std::vector<double>{9, 8}));
    EXPECT_EQ(positions(0, 0), 2);
  }
}

TEST(Alternate, AStepThatPollsForLongIsCancelled) {
  Script script{{9}, {1}};
  Alternation steps = script.steps();
  steps.place = [](Positions&, const Poll& poll) -> double {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (std::chrono::steady_clock::now() < end) poll();
    return 9;
  };
  int asked = 0;
  Positions positions = origin();
  const Report report = alternate(
      {}, [&](const Progress&) { return ++asked < 3; }, positions, steps);
  EXPECT_EQ(report.stop, Termination::cancelled);
  EXPECT_EQ(asked, 3);
}

TEST(Alternate, PassesThatWatchMovementAloneLetTheEnergyRise) {
  StopRule stop;
  stop.by_energy = false;
  stop.movement = 0.1;
  Script script{{5, 9, 9, 9, 9}, {1, 1, 1, 1, 0.01}};
  Positions positions = origin();
  const Report report = alternate(stop, {}, positions, script.steps());
  EXPECT_EQ(report.stop, Termination::moved_little);
  EXPECT_EQ(report.passes, 5);
  EXPECT_EQ(report.best_pass, 4);
}

/// Passes that start ten further than the last one ended.
Alternation leaping(Script& script, std::vector<double>& fitted) {
  Alternation steps = script.steps();
  steps.next = [](const Positions&, const Positions& end, const Poll&) { return Positions(end.array() + 10); };
  steps.fit = [&](const Positions& start, const Poll&) { fitted.push_back(start(0, 0)); };
  return steps;
}

TEST(Alternate, APassStartsWhereNextSaysAndMovesFromThere) {
  StopRule stop;
  stop.pass_limit = 3;
  Script script{{9, 8, 7}, {1, 2, 3}};
  std::vector<double> fitted;
  Positions positions = origin();
  const Report report = alternate(stop, {}, positions, leaping(script, fitted));
  EXPECT_EQ(fitted, (std::vector<double>{11, 23}));
  EXPECT_EQ(positions(0, 0), 26);
  EXPECT_EQ(report.movements, (std::vector<double>{1, 2, 3}));
}

TEST(Alternate, ACancelKeepsThePassNotWhereTheNextWouldStart) {
  Script script{{9, 8, 7}, {1, 1, 1}};
  std::vector<double> fitted;
  Positions positions = origin();
  alternate(
      {}, [](const Progress& p) { return p.pass < 2; }, positions, leaping(script, fitted));
  EXPECT_EQ(positions(0, 0), 12);
}

TEST(Alternate, AnUndefinedEnergyIsAnError) {
  Script script{{std::numeric_limits<double>::quiet_NaN()}, {1}};
  Positions positions = origin();
  EXPECT_THROW(alternate({}, {}, positions, script.steps()), Unsolvable);
}

}  // namespace
}  // namespace swage
