#include "runfile/table_rows.h"

#include <algorithm>

#include "results/fraction_table.h"
#include "results/group_request.h"
#include "results/groups.h"

namespace quasimc {

TableRows::TableRows(const RunFile& run, const TableSpec& table) {
    if (table.where.empty()) {
        return;
    }
    const WhereExpression where(table.where);
    if (table.rows == CsvRows::groups) {
        const std::vector<std::string> keys = group_keys(run);
        std::vector<std::string_view> known(keys.begin(), keys.end());
        known.insert(known.end(), {"by", "value", "area", kLayer});
        where.check_names(known, "label");
        where_ = where;
        return;
    }
    const OrganValues values(run.scene, group_spec(run.spec));
    where.check_names(values.names(), "label");
    for (const Organ& organ : run.scene.organs()) {
        organs_.push_back(values.holds(where, organ));
    }
}

bool TableRows::has(const OrganGroup& group) const {
    return !where_ || where_->holds([&](std::string_view name) -> std::optional<WhereValue> {
        if (const std::string* label = find_label(group.labels, name)) {
            return WhereValue::of_text(*label);
        }
        if (name == "by") {
            return WhereValue{group.by};
        }
        if (name == "value") {
            return WhereValue::of_text(group.value);
        }
        return name == "area" ? std::optional(WhereValue::of_number(group.area)) : std::nullopt;
    });
}

std::vector<std::string> group_keys(const RunFile& run) {
    const std::vector<std::string_view> known = label_keys(run.scene);
    std::vector<std::string> keys;
    for (const std::string& text : run.spec.groups) {
        for (const std::string& key : parse_group(text, known).keys) {
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
                keys.push_back(key);
            }
        }
    }
    return keys;
}

std::vector<std::string_view> table_quantities(CsvRows rows, CsvTimes times) {
    std::vector<std::string_view> names;
    for (const QuantityEntry& entry : quantity_table()) {
        names.push_back(entry.name);
    }
    const bool is_of_groups = rows == CsvRows::groups;
    for (std::size_t i = 0; is_of_groups && i < share_table().size(); ++i) {
        names.push_back(share_table()[i].name);
    }
    if (times == CsvTimes::days) {
        return names;
    }
    names.insert(names.end(), {"sunlit_fraction", "ratios"});
    if (is_of_groups) {
        names.emplace_back("sunlit_area");
        for (const FractionEntry& entry : fraction_table()) {
            names.push_back(entry.name);
        }
    }
    return names;
}

}  // namespace quasimc
