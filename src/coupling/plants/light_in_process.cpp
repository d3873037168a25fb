#include "coupling/plants/light_in_process.h"

#include <exception>
#include <utility>

#include "base/text.h"
#include "coupling/plants/master_messages.h"
#include "coupling/plants/number_line.h"

namespace quasimc {
namespace {

Vec3 six_digits_of(const Vec3& v) {
    return {six_digits(v.x), six_digits(v.y), six_digits(v.z)};
}

Query query_of(const PlantQuery& of_plant) {
    Query query;
    query.id = of_plant.id;
    query.slots = static_cast<std::uint32_t>(of_plant.parameters.size());
    query.asks = query.slots > 0 && of_plant.parameters[0] >= 0;
    const TurtleFrame& f = of_plant.frame;
    query.turtle = {
        six_digits_of(f.position), six_digits_of(f.heading), six_digits_of(f.left),
        six_digits_of(f.up)};
    return query;
}

}  // namespace

LightInProcess::LightInProcess(
    Specification specification,
    Notices& notices,
    std::function<void(const std::string&)> send,
    Options options)
    : options_(std::move(options)),
      send_(std::move(send)),
      light_(std::move(specification), notices) {}

Drawing* LightInProcess::query(const PlantQuery& query) {
    if (std::exchange(is_new_pass_, false)) {
        pass_.clear();
        is_answered_.clear();
    }
    Query added = query_of(query);
    added.parameters.first = static_cast<std::uint32_t>(pass_.parameters.size());
    added.polygons.first = static_cast<std::uint32_t>(pass_.polygons.size());
    if (options_.format.following_module) {
        added.organ = query.following;
        added.parameters.count = static_cast<std::uint32_t>(query.following_parameters.size());
        for (const float parameter : query.following_parameters) {
            pass_.parameters.push_back(six_digits(static_cast<double>(parameter)));
        }
    }
    pass_.queries.push_back(std::move(added));
    is_answered_.push_back(query.is_answered);
    const bool is_drawn =
        options_.format.interprets(query.following, query.following_parameters.size());
    return is_drawn ? &graphics_ : nullptr;
}

std::vector<PlantAnswer> LightInProcess::answers(std::int64_t step) {
    if (std::exchange(is_new_pass_, true)) {
        return {};  // without queries, nothing would be sent to the program
    }
    pass_.step = step;
    Answers computed;
    std::exception_ptr fault;
    try {
        light_.answer(pass_, options_.check, computed);
        light_.report_if_unlit();
    } catch (const InputError&) {
        fault = std::current_exception();
    }
    errors_.report_step(steps_, fault);
    light_.set_step(++steps_);
    return answers_from(computed);
}

std::vector<PlantAnswer> LightInProcess::answers_from(const Answers& computed) const {
    std::vector<PlantAnswer> answers;
    answers.reserve(computed.list.size());
    std::string line;
    for (const Answer& answer : computed.list) {
        if (!is_answered_[answer.query]) {
            continue;
        }
        const Query& query = pass_.queries[answer.query];
        const auto values =
            std::span(computed.values).subspan(answer.values.first, answer.values.count);
        line.clear();
        append_answer(line, query.id, query.slots, values);  // long lines have fewer digits
        answers.push_back(read_answer(trimmed(line), "QuasiMC"));
    }
    return answers;
}

StepSnapshot LightInProcess::snapshot() const {
    return {pass_.step, light_.specification(), light_.lighting(), light_.shared_last()};
}

}  // namespace quasimc
