#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>

namespace {

unsigned cases_run = 0;

/// Counts what passes the filters, and nothing else.
struct Counter : doctest::IReporter {
  explicit Counter(const doctest::ContextOptions&) {}
  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats& all) override { cases_run = all.numTestCasesPassingFilters; }
  void test_case_start(const doctest::TestCaseData&) override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_end(const doctest::CurrentTestCaseStats&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}
};
REGISTER_LISTENER("counter", 1, Counter);

}  // namespace

/// As doctest's own, but what runs no case at all has failed: else a test that is registered by a name that no case has
/// would pass for ever.
int main(int argc, char** argv) {
  doctest::Context context(argc, argv);
  const int result = context.run();
  const doctest::ContextOptions* options = doctest::getContextOptions();
  if (context.shouldExit() || (options && (options->list_test_cases || options->list_test_suites || options->count)))
    return result;
  if (cases_run > 0) return result;
  std::fputs("No test case has such a name.\n", stderr);
  return 1;
}
