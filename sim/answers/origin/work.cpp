#include "sim/answers/origin/work.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "sim/words/explain.hpp"
#include "traces/events/fields.hpp"
#include "traces/scene.hpp"

namespace zstep::answers {
namespace {

constexpr std::size_t most_links = 240, most_numbers = 900;

}  // namespace

const std::string& Datum::name() const { return work_.chain.links[link_].values[place_].name; }
double Datum::number() const { return work_.chain.links[link_].values[place_].value; }
ChainValue& Datum::value() const { return work_.chain.links[link_].values[place_]; }

void Datum::is(std::string formula, std::vector<Given> operands, bool exact) {
  ChainValue& told = value();
  told.formula = std::move(formula);
  told.exact = exact && work_.conventions.number_format == NumberFormat::float64;
  told.tolerance = formulas::tolerance_of(work_.scene, work_.trace.header());
  told.rounds = rounding_word(work_.conventions);
  for (Given& given : operands)
    told.operands.push_back(
        {std::move(given.symbol), given.number.value, given.number.link, std::move(given.number.name)});
}

std::vector<Given> Operands::in(const Formula& formula) const {
  std::vector<Given> used;
  const auto known = [](const Given& one, const auto& all) {
    return std::any_of(all.begin(), all.end(), [&](const auto& other) { return other.symbol == one.symbol; });
  };
  for (const Given& one : given_)
    if (known(one, formula.operands()) && !known(one, used)) used.push_back(one);
  return used;
}

void Datum::same_as(const std::string& symbol, const Number& number) { is(symbol, {{symbol, number}}); }

void Datum::comes_of(std::string note, const std::vector<Number>& numbers) {
  ChainValue& told = value();
  told.note = std::move(note);
  for (const Number& number : numbers) told.operands.push_back({number.name, number.value, number.link, number.name});
}

void Datum::note(std::string text) { value().note = std::move(text); }

void Datum::holds_if(std::string formula, std::vector<Given> operands) {
  value().condition = true;
  is(std::move(formula), std::move(operands));
}

void Datum::word(std::string one) { value().word = std::move(one); }

bool Datum::told() const {
  const ChainValue& is = value();
  return !is.formula.empty() || !is.note.empty() || !is.operands.empty();
}

void Datum::given() { work_.chain.links[link_].given = true; }

void Datum::at_source(std::string source) { work_.chain.links[link_].source = std::move(source); }

const State& Work::state() const {
  if (now_.state) return *now_.state;
  const State& whole = buffers();
  State& kept = now_.state.emplace();
  kept.position = whole.position, kept.machine = whole.machine, kept.vertices = whole.vertices;
  return kept;
}

std::string Work::depth_name() const { return depth_symbol(scene, conventions); }
std::string Work::label(std::int32_t polygon) const { return polygon_label(scene, polygon); }
const std::string& Work::piece(std::int32_t number) const {
  const auto [known, is_new] = now_.pieces.try_emplace(number);
  if (is_new) known->second = piece_label(scene, machine(), number);
  return known->second;
}
std::string Work::vertex_name(std::int32_t vertex) const { return vertex_label(scene, vertex); }

std::string Work::step_name(std::int64_t step) const {
  const StepInfo* info =
      step > 0 && step <= trace.size() ? find_step(trace.header().page, trace.event(step).step) : nullptr;
  return info ? info->name : "";
}

std::string Work::source_line(std::int32_t line) const {
  const std::string file = std::filesystem::path(scene.source).filename().string();
  const std::string name = file == "built-in" || file.empty() ? fmt::format("scene {}", scene.name) : file;
  return line > 0 ? fmt::format("{}:{}", name, line) : name;
}
std::string Work::source_of_polygon(std::int32_t polygon) const {
  const Polygon* found = entry(scene.polygons, polygon);
  return source_line(found ? found->source_line : 0);
}
std::string Work::source_at(std::int32_t point, std::int32_t line) const {
  const Placement* placement = placement_of(scene, point);
  if (placement == nullptr) return source_line(line);
  const std::string file = std::filesystem::path(placement->source).filename().string();
  return line > 0 ? fmt::format("{}:{}", file, line) : file;
}
std::string Work::source_of_point(std::int32_t point) const {
  const std::int32_t* known = entry(scene.point_lines, point);
  return source_at(point, known ? *known : 0);
}
std::string Work::source_of_value(const VertexAttribute& attribute, std::int32_t value, std::int32_t vertex) const {
  const std::int32_t* known = entry(attribute.lines, value);
  return source_at(vertex, known ? *known : 0);
}

std::int32_t Work::link_of(std::int64_t step, const std::string& subject, const std::string& what) {
  const auto [known, is_new] = links_.try_emplace({step, subject}, size32(chain.links));
  if (!is_new) return known->second;
  if (chain.links.size() >= most_links || numbers_ >= most_numbers) {
    links_.erase(known);
    chain.cut = true;
    return -1;
  }
  ChainLink link;
  link.step = step;
  link.parent = current_;
  link.depth = current_ < 0 ? 0 : chain.links[current_].depth + 1;
  link.what = what;
  chain.links.push_back(std::move(link));
  return known->second;
}

std::optional<std::size_t> Work::place_of(std::int32_t link, const std::string& name, double value) {
  std::vector<ChainValue>& values = chain.links[link].values;
  for (const ChainValue& known : values)
    if (known.name == name) return std::nullopt;
  ++numbers_;
  ChainValue told;
  told.name = name;
  told.value = value;
  values.push_back(std::move(told));
  return values.size() - 1;
}

Number Work::field(std::int64_t step, std::string_view name) {
  const Event event = trace.event(step).event;
  const auto value = field_number(event, name);
  if (!value) return 0;
  const auto told = [&] {
    return derived(step, "", what_happens(*this, step, event), shown_name(event, name, depth_name()), *value,
                   [&](Datum& datum) { tell_field(datum, *this, step, event, name); });
  };
  if (!is_of_other_work(step, event)) return told();
  Moment outer = std::exchange(now_, Moment{step});
  Number number = told();
  now_ = std::move(outer);
  return number;
}

/// Edges have their numbers in one polygon's work, but where one table has those of all; and a span its scan line.
/// Where pixels come after the spans of other lines or of other polygons, the state at the pixel is not theirs.
bool Work::is_of_other_work(std::int64_t step, const Event& event) const {
  const auto fields = fields_of_kind(event.index());
  if (step >= now_.at ||
      std::none_of(fields.begin(), fields.end(), [](const FieldOfKind& field) { return field.thing == Thing::edge; }))
    return false;
  const auto [known, is_new] = now_.of_other_work.try_emplace(step);
  if (is_new)
    known->second = (!has_one_table() && next_mark(trace, step) <= now_.at) ||
                    (holds<SpanBegin>(event) && next_of<ScanLineBegin>(trace, step, now_.at + 1));
  return known->second;
}

Number Work::field(const Step& step, std::string_view name, double otherwise) {
  return step && *step >= 1 && *step <= trace.size() ? field(*step, name) : Number(otherwise);
}

const VertexSteps& Work::steps_of(std::int32_t vertex) {
  const auto known = now_.vertices.find(vertex);
  if (known != now_.vertices.end()) return known->second;
  return now_.vertices.emplace(vertex, steps_of_vertex(trace, machine(), at(), vertex)).first->second;
}

Step Work::step_of_edge(std::int32_t edge) {
  const auto [known, is_new] = now_.edges.try_emplace(edge);
  if (is_new) known->second = answers::step_of_edge(trace, machine(), at(), edge);
  return known->second;
}

void Work::later(std::int64_t step, std::string_view name, const std::string& symbol) {
  if (step >= 1) later_.push_back({step, std::string(name), symbol, current_});
}

Number Work::kept(std::int64_t step, const std::string& subject, const std::string& what, const std::string& name,
                  double value, const char* field, const std::function<Step()>& since, const char* never) {
  return derived(step, subject, what, name, value, [&](Datum& datum) {
    const Step wrote = since();
    if (!wrote && *never) return datum.note(never);
    datum.is(field, {{field, value}});
    if (wrote) later(*wrote, field, field);
  });
}

void Work::also(std::int64_t step, std::string_view name) { later_.push_back({step, std::string(name), "", 0}); }

void Work::run_later() {
  while (!later_.empty()) {
    const Later next = std::move(later_.front());
    later_.pop_front();
    now_ = Moment{next.step};
    current_ = next.parent;
    const Number number = field(next.step, next.name);
    if (number.link < 0 || next.parent < 0) continue;
    for (ChainValue& value : chain.links[next.parent].values)
      for (Operand& operand : value.operands)
        if (operand.link < 0 && operand.symbol == next.symbol) operand.link = number.link, operand.name = number.name;
  }
  current_ = -1;
}

}  // namespace zstep::answers
