// SQL over a trace: every answer that an index may shorten is held against one that reads all, and nothing but reading
// is possible.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "sim/query/database.hpp"
#include "sim/query/virtual_table.hpp"
#include "tests/golden/golden.hpp"
#include "tests/unit/sim/polygons_by_hand.hpp"
#include "tests/unit/traces/some_trace.hpp"
#include "tests/where.hpp"
#include "traces/error.hpp"
#include "traces/file/container.hpp"

using namespace zstep;
using query::Database, query::Limits, query::Stopped;
using Cell = query::Value;

namespace {

using Rows = std::vector<std::vector<Cell>>;

Rows ask(Database& database, const std::string& sql) {
  Rows rows;
  database.run(
      sql, {}, [](const std::vector<std::string>&) {},
      [&](std::span<const Cell> values) {
        rows.emplace_back(values.begin(), values.end());
        return true;
      });
  return rows;
}

std::int64_t number(Database& database, const std::string& sql) {
  const Rows rows = ask(database, sql);
  REQUIRE(rows.size() == 1);
  return std::get<std::int64_t>(rows[0][0]);
}

std::string refusal(Database& database, const std::string& sql) {
  try {
    ask(database, sql);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// NULL stands for -1.
bool holds(const Cell& cell, std::int64_t expected) {
  const auto* whole = std::get_if<std::int64_t>(&cell);
  return expected < 0 ? std::holds_alternative<std::monostate>(cell) : whole && *whole == expected;
}

Trace golden(const std::string& name) { return open_jsonl(test::in_checkout("tests/golden/") + name + ".jsonl"); }

/// Of the whole trace, by going through it once: the polygon of each event, and the scan line at work.
struct AtWork {
  std::int32_t polygon = no_polygon, scan_line = -1;
};
std::vector<AtWork> all_at_work(const Trace& trace) {
  std::vector<AtWork> all(static_cast<std::size_t>(trace.size()) + 1);
  const std::vector<std::int32_t> polygons = test::polygons_by_hand(trace);
  AtWork now;
  for (std::int64_t p = 1; p <= trace.size(); ++p) {
    const Event& event = trace.event(p).event;
    now.polygon = polygons[static_cast<std::size_t>(p)];
    if (holds<PolygonBegin>(event) || holds<PieceDraw>(event)) now.scan_line = -1;
    else if (const auto* line = get_if<ScanLineBegin>(&event)) now.scan_line = line->y;
    all[static_cast<std::size_t>(p)] = now;
  }
  return all;
}

/// Events of every kind, so many that there are several blocks; pixels and polygons within a small scene.
Trace long_trace() {
  Header header = some_header();
  Scene scene = some_scene();
  TraceRecorder record(header, scene);
  std::mt19937_64 random(5);
  for (int k = 0; k < 200'000; ++k) {
    const auto x = static_cast<std::int32_t>(random() % 16), y = static_cast<std::int32_t>(random() % 12);
    const auto polygon = static_cast<std::int32_t>(random() % 2);
    const auto at = [&]<class E>(const E& event) { record(Step<E>{step_of(kind_of<E>)}, event); };
    if (k % 997 == 0) at(PolygonBegin{polygon, polygon});
    else if (k % 91 == 0) at(ScanLineBegin{y});
    else if (k % 3 == 0) at(DepthCompare{x, y, static_cast<double>(k), k % 2 == 0});
    else if (k % 3 == 1) at(DepthWrite{x, y, static_cast<double>(k)});
    else at(PixelWrite{x, y, polygon});
  }
  record.finish();
  return Trace::from_bytes(record.take_bytes(), "long");
}

}  // namespace

TEST_SUITE("query") {
  TEST_CASE("every table has as many rows as there are events, in the order of steps, and the context of each") {
    test::for_each_golden([&](const std::string& name, const Trace& trace) {
      CAPTURE(name);
      Database database(trace);
      const std::vector<AtWork> at_work = all_at_work(trace);
      std::int64_t rows = 0;
      for (const std::uint8_t kind : query::kinds_in(trace)) {
        const query::Table& table = query::all_tables()[kind];
        std::int64_t last = 0;
        for (const auto& row : ask(database, "select step, name, polygon, scan_line from " + table.name)) {
          const std::int64_t step = std::get<std::int64_t>(row[0]);
          REQUIRE(step > last);
          last = step;
          const RecordedEvent& recorded = trace.event(step);
          REQUIRE(recorded.event.index() == kind);
          CHECK(std::get<std::string>(row[1]) == find_step(trace.header().page, recorded.step)->name);
          const AtWork& now = at_work[static_cast<std::size_t>(step)];
          if (!table.own_polygon) CHECK(holds(row[2], now.polygon));
          CHECK(holds(row[3], now.scan_line));
          ++rows;
        }
      }
      CHECK(rows == trace.size());
    });
  }

  TEST_CASE("columns hold what the fields hold: whole numbers, numbers, truth and words") {
    const Trace trace = golden("pyramid-behind");
    Database database(trace);
    for (const auto& row : ask(database, "select step, x, y, z, nearer from depth_compare")) {
      const auto& compare = get<DepthCompare>(trace.event(std::get<std::int64_t>(row[0])).event);
      CHECK(holds(row[1], compare.x));
      CHECK(holds(row[2], compare.y));
      CHECK(std::get<double>(row[3]) == compare.z);
      CHECK(holds(row[4], compare.nearer));
    }
    const Rows facing = ask(database, "select distinct facing from facing_test order by 1");
    REQUIRE(facing.size() == 2);
    CHECK(std::get<std::string>(facing[0][0]) == "back");
    CHECK(std::get<std::string>(facing[1][0]) == "front");
  }

  TEST_CASE("no two columns of a table have the same name") {
    for (const query::Table& table : query::all_tables()) {
      std::set<std::string> names;
      for (const query::Column& column : table.columns)
        CHECK_MESSAGE(names.insert(column.name).second, table.name, ".", column.name);
    }
  }

  TEST_CASE("a question that names a pixel, a polygon or steps gives what reading all gives") {
    const Trace trace = long_trace();
    Database database(trace);
    std::mt19937_64 random(9);
    // In the second form no index can be used: + makes an expression of the column.
    const auto same = [&](const std::string& table, const std::string& indexed, const std::string& plain) {
      CAPTURE(indexed);
      const std::string select = "select step from " + table + " where ";
      const Rows some = ask(database, select + indexed), all = ask(database, select + plain);
      CHECK(some == all);
      return some.size();
    };
    std::size_t rows = 0;
    for (int round = 0; round < 3; ++round) {
      const std::string x = std::to_string(random() % 16), y = std::to_string(random() % 12),
                        polygon = std::to_string(random() % 3);
      const std::string low = std::to_string(random() % 200'000), high = std::to_string(random() % 210'000);
      rows += same("depth_compare", "x = " + x + " and y = " + y, "+x = " + x + " and +y = " + y);
      rows += same("depth_write", "step between " + low + " and " + high, "+step between " + low + " and " + high);
      rows += same("depth_write", "step > " + low + " and step < " + high + ".5 and y = " + y,
                   "+step > " + low + " and +step < " + high + ".5 and +y = " + y);
      rows +=
          same("depth_compare", "polygon = " + polygon + " and x = " + x, "+polygon = " + polygon + " and +x = " + x);
      rows += same("pixel_write", "polygon = " + polygon + " and step >= " + low,
                   "+polygon = " + polygon + " and +step >= " + low);
      // Each bound is the step of a row: x, and the same where no index is used, hold it or not alike.
      const std::string row = std::to_string(random() % 60'000 * 3 + 2);
      for (const char* sign : {" <= ", " < ", " >= ", " > ", " = "}) {
        for (const std::string& bound : {row, row + ".0", row + ".5"})
          rows += same("depth_write", "step" + (sign + bound), "+step" + (sign + bound));
      }
      rows += same("scan_line_begin", "rowid = " + low, "+step = " + low);
    }
    CHECK(rows > 15'000);
    CHECK(ask(database, "select * from depth_compare where x = 3.5").empty());
    CHECK(ask(database, "select * from depth_compare where x = 'three'").empty());
    CHECK(ask(database, "select * from depth_compare where x = null").empty());
    CHECK(ask(database, "select * from depth_compare where step > 1e300").empty());
    CHECK(number(database, "select count(*) from depth_compare where step > -1e300") ==
          number(database, "select count(*) from depth_compare"));
    CHECK(ask(database, "select step from depth_compare where step < 9000 order by step desc limit 1") ==
          ask(database, "select max(step) from depth_compare where step < 9000"));
  }

  TEST_CASE("tables can be joined, also one with itself, and used again and again") {
    const Trace trace = long_trace();
    Database database(trace);
    CHECK(
        number(database,
               "select count(*) from depth_compare a join depth_compare b on b.step = a.step + 3 where a.step < 3000") >
        500);
    CHECK(number(database,
                 "select count(*) from pixel_write a, depth_write b, depth_compare c, scan_line_begin d, polygon_begin "
                 "e, depth_write f, "
                 "depth_write g where a.step = b.step + 1 and b.step = c.step + 1 and d.step = 92 and e.step = 1 and "
                 "f.step = b.step + 3 "
                 "and g.step = f.step + 3 and c.step between 150000 and 150020") > 0);
  }

  TEST_CASE("nothing but reading") {
    const Trace trace = golden("delhi");
    Database database(trace);
    for (const char* sql :
         {"delete from depth_compare", "insert into depth_compare(x) values (1)", "update depth_compare set x = 1",
          "create table t(a)", "drop table depth_compare", "attach 'other.db' as other", "pragma writable_schema = on",
          "pragma temp_store_directory = '/'", "vacuum", "create virtual table t using trace(1)", "begin",
          "select load_extension('x')", "vacuum into 'copy.db'", "create temp table t as select 1",
          "select * from pragma_database_list", "reindex", "analyze", "detach main"}) {
      CAPTURE(sql);
      const std::string said = refusal(database, sql);
      CHECK(said.find("query: ") == 0);
      CHECK(said.find('\n') == std::string::npos);
    }
    CHECK(number(database, "select count(*) from depth_compare") == 49);
  }

  TEST_CASE("mistakes are one line each, with a way out") {
    const Trace trace = golden("delhi");
    Database database(trace);
    CHECK(refusal(database, "select * from depth_compares")
              .find("no such table: depth_compares; the tables of this trace are buffers_clear, ") !=
          std::string::npos);
    CHECK(refusal(database, "select depth from depth_compare").find("no such column: depth") != std::string::npos);
    CHECK(refusal(database, "selekt").find("syntax error, at \"selekt\"") != std::string::npos);
    CHECK(refusal(database, "").find("asks nothing") != std::string::npos);
    CHECK(refusal(database, "  -- only a remark").find("asks nothing") != std::string::npos);
    CHECK(refusal(database, "select 1; select 2").find("more than one statement") != std::string::npos);
    CHECK(refusal(database, "select 1;").empty());
    CHECK(refusal(database, "select 1; -- and that is all").empty());
    CHECK(refusal(database, "select '" + std::string(200'000, 'x') + "'").find("longer than") != std::string::npos);
    CHECK(refusal(database, "select zeroblob(2000000000)").find("query: ") == 0);
  }

  TEST_CASE("a question without end is stopped by its time, and by who asks") {
    const Trace trace = golden("delhi");
    Database database(trace);
    const std::string endless =
        "with recursive n(i) as (select 1 union all select i + 1 from n) select count(*) from n";
    const auto run = [&](const Limits& limits) {
      database.run(
          endless, limits, [](const auto&) {}, [](auto) { return true; });
    };
    Limits limits;
    limits.seconds = 0.05;
    bool by_time = false;
    try {
      run(limits);
    } catch (const Stopped& stopped) {
      by_time = stopped.by_time;
    }
    CHECK(by_time);
    int looks = 0;
    limits = {};
    limits.stop = [&] { return ++looks > 3; };
    bool by_me = false;
    try {
      run(limits);
    } catch (const Stopped& stopped) {
      by_me = !stopped.by_time;
    }
    CHECK(by_me);
    CHECK(number(database, "select 7") == 7);
  }

  TEST_CASE("a damaged block is said as the trace says it, and the other steps can still be asked") {
    // A recording of several blocks with one byte of the second turned over.
    const Scene scene = some_scene();
    TraceRecorder record(some_header(), scene);
    for (int k = 0; k < 150'000; ++k)
      record(Step<DepthWrite>{step_of(kind_of<DepthWrite>)},
             DepthWrite{k % 16, k % 12, std::sqrt(static_cast<double>(k))});
    record.finish();
    Bytes bytes = record.take_bytes();
    bytes[bytes.size() / 2] ^= 1;
    const Trace trace = Trace::from_bytes(bytes, "hurt.ztrace");
    Database database(trace);
    CHECK(refusal(database, "select count(*) from depth_write").find("hurt.ztrace: is damaged in steps ") == 0);
    CHECK(number(database, "select count(*) from depth_write where step <= 1000") == 1000);
  }
}
