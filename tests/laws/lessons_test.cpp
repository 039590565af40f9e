// What every lesson must hold: it runs, it says only what its trace shows, it asks before it answers, and it is short.
#include <algorithm>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include "sim/classroom/markdown.hpp"
#include "tests/laws/course.hpp"

namespace zstep {
namespace {

using test::course;

std::string place(const Lesson& lesson, const Stop& stop) {
  return lesson.path.filename().string() + ":" + std::to_string(stop.line);
}

/// Sentences of a text, code blocks and lists left aside.
int sentences(const std::string& text) {
  int count = 0;
  for (const TextBlock& block : parse_markdown(text)) {
    if (block.kind != TextBlock::Kind::paragraph) continue;
    const std::string words = plain_text({block});
    for (std::size_t i = 0; i < words.size(); ++i) {
      const bool ends =
          words[i] == '.' || words[i] == '?' || words[i] == '!' || (words[i] == ':' && i + 1 == words.size());
      if (ends && (i + 1 == words.size() || words[i + 1] == ' ')) ++count;
    }
  }
  return count;
}

TEST_CASE("the lessons stand in teaching order: that of the numbers their files begin with, none twice") {
  int last = 0;
  for (const Lesson& lesson : course().written) {
    const int number = std::stoi(lesson.path.stem().string());
    CHECK_MESSAGE(number > last, lesson.path.string());
    CHECK(lesson.path.stem().string() == std::to_string(number) + "-" + lesson.id);
    last = number;
  }
  for (const Lesson& lesson : course().written) {
    CHECK(find_lesson(lesson.id).title == lesson.title);
    CHECK(find_lesson(lesson.path.string()).title == lesson.title);
  }
}

TEST_CASE("lessons of a theme follow each other, and each is read in about ten minutes") {
  std::vector<std::string> themes;
  for (const Lesson& lesson : course().written) {
    CAPTURE(lesson.id);
    CHECK_FALSE(lesson.theme.empty());
    if (themes.empty() || themes.back() != lesson.theme) {
      CHECK(std::find(themes.begin(), themes.end(), lesson.theme) == themes.end());
      themes.push_back(lesson.theme);
    }
    CHECK(reading_minutes(lesson) > 5);
    CHECK(reading_minutes(lesson) < 16);
  }
  CHECK(themes.size() > 4);
}

TEST_CASE("every stop is found in the lesson's own run, in order") {
  for (std::size_t i = 0; i < course().told.size(); ++i) {
    const Lesson& lesson = course().told[i];
    CHECK(lesson.stops.size() >= 8);
    CHECK(lesson.stops.size() <= 25);  // ten minutes
    std::int64_t last = 0;
    for (const Stop& stop : lesson.stops) {
      CAPTURE(place(lesson, stop));
      CHECK(stop.position >= last);
      CHECK(stop.position <= course().traces[i].size());
      last = stop.position;
    }
  }
}

TEST_CASE("nothing is left unfilled") {
  for (const Lesson& lesson : course().told) {
    for (const Stop& stop : lesson.stops) {
      CAPTURE(place(lesson, stop));
      std::string all = stop.heading + stop.text;
      if (stop.question) {
        all += stop.question->text;
        for (const Answer& answer : stop.question->answers) all += answer.text + answer.reply;
      }
      CHECK(all.find_first_of("{}") == std::string::npos);
    }
  }
}

TEST_CASE("every question has one right answer, and a reply to each") {
  for (const Lesson& lesson : course().told) {
    CAPTURE(lesson.id);
    int questions = 0;
    std::set<std::size_t> right_places;
    for (const Stop& stop : lesson.stops) {
      if (!stop.question) continue;
      CAPTURE(place(lesson, stop));
      ++questions;
      std::set<std::string> texts, replies;
      int right = 0;
      for (std::size_t i = 0; i < stop.question->answers.size(); ++i) {
        const Answer& answer = stop.question->answers[i];
        if (answer.right) right_places.insert(i);
        right += answer.right;
        texts.insert(answer.text);
        replies.insert(answer.reply);
        CHECK(answer.reply.size() > 10);
        CHECK(answer.reply.find("try again") == std::string::npos);
        CHECK(sentences(answer.reply) <= 3);
      }
      CHECK(right == 1);
      CHECK(stop.question->answers.size() >= 3);
      CHECK(texts.size() == stop.question->answers.size());
      CHECK(replies.size() == stop.question->answers.size());
    }
    CHECK(questions >= 4);
    CHECK(right_places.size() >= 2);  // or the place gives it away
    CHECK_FALSE(lesson.stops.back().question.has_value());
  }
}

/// How many characters an answer has as it is shown: filled, without marks of Markdown.
std::size_t shown_length(const Answer& answer) {
  const std::string shown = plain_text(parse_markdown(answer.text));
  return static_cast<std::size_t>(std::count_if(shown.begin(), shown.end(), [](char c) {
    return (static_cast<unsigned char>(c) >> 6) != 2;  // what follows in UTF-8 is of the same character
  }));
}

TEST_CASE("neither place nor length gives the right answer away") {
  int questions = 0, shortest = 0, longest = 0;
  std::map<std::size_t, int> places;
  for (const Lesson& lesson : course().told) {
    for (const Stop& stop : lesson.stops) {
      if (!stop.question) continue;
      std::size_t place = 0, right = 0, least_wrong = std::string::npos, most_wrong = 0;
      const std::vector<Answer>& answers = stop.question->answers;
      for (std::size_t i = 0; i < answers.size(); ++i) {
        const std::size_t length = shown_length(answers[i]);
        if (answers[i].right) place = i, right = length;
        else least_wrong = std::min(least_wrong, length), most_wrong = std::max(most_wrong, length);
      }
      ++questions;
      ++places[place];
      shortest += right<least_wrong, longest += right> most_wrong;
    }
  }
  // Of three answers each is a third of all that is to be guessed; an eighth more is chance.
  const auto few_enough = [&](int of) { return 8 * of <= 3 * questions; };
  CHECK_MESSAGE(few_enough(shortest), shortest << " of " << questions << " right answers are the shortest");
  CHECK_MESSAGE(few_enough(longest), longest << " of " << questions << " right answers are the longest");
  for (const auto& at : places)
    CHECK_MESSAGE(few_enough(at.second),
                  at.second << " of " << questions << " right answers at place " << at.first + 1);
}

TEST_CASE("a question is asked before the step that answers it") {
  for (const Lesson& lesson : course().told) {
    for (const Stop& stop : lesson.stops) {
      CAPTURE(place(lesson, stop));
      if (stop.heading.substr(0, 8) == "Predict:") CHECK(stop.question.has_value());
      if (stop.anchor.substr(0, 7) == "before:" && stop.question)
        CHECK(stop.position < course().traces[static_cast<std::size_t>(&lesson - course().told.data())].size());
    }
  }
}

TEST_CASE("narration is at most two sentences and fits a projector") {
  for (const Lesson& lesson : course().told) {
    for (const Stop& stop : lesson.stops) {
      CAPTURE(place(lesson, stop));
      CHECK(sentences(stop.text) <= 2);
      CHECK(stop.heading.size() <= 60);
      for (const TextBlock& block : parse_markdown(stop.text)) {
        const std::string words = plain_text({block});
        if (block.kind != TextBlock::Kind::code) {
          CHECK(words.size() <= 260);
          continue;
        }
        for (std::size_t at = 0; at < words.size();) {
          const std::size_t end = std::min(words.find('\n', at), words.size());
          std::size_t columns = 0;
          for (std::size_t i = at; i < end; ++i) columns += (static_cast<unsigned char>(words[i]) >> 6) != 2;
          CHECK_MESSAGE(columns <= 34, words.substr(at, end - at));
          at = end + 1;
        }
      }
    }
  }
}

TEST_CASE("a lesson has its shape: problem, idea, prediction, failure, cost, and something to try") {
  for (const Lesson& lesson : course().told) {
    CAPTURE(lesson.id);
    const auto has = [&](std::string_view start) {
      for (const Stop& stop : lesson.stops) {
        if (stop.heading.substr(0, start.size()) == start) return true;
      }
      return false;
    };
    CHECK(lesson.stops.front().position == 0);
    CHECK(has("One idea"));
    CHECK(has("Predict"));
    CHECK(has("Where it fails"));
    CHECK(has("What it costs"));
    CHECK(lesson.stops.back().heading == "Try it");
    CHECK(lesson.summary.size() <= 90);
  }
}

TEST_CASE("a term is introduced once, in bold") {
  for (const Lesson& lesson : course().told) {
    CAPTURE(lesson.id);
    std::set<std::string> terms;
    for (const Stop& stop : lesson.stops) {
      for (const TextBlock& block : parse_markdown(stop.text)) {
        for (const TextRun& run : block.runs) {
          if (run.bold) CHECK_MESSAGE(terms.insert(run.text).second, run.text);
        }
      }
    }
    CHECK_FALSE(terms.empty());
  }
}

}  // namespace
}  // namespace zstep
