#pragma once

#include "sinew/scene/json.h"

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace sinew {

/// What an editor would say.
class SchemaCheck {
  public:
    explicit SchemaCheck(const json::Value& schema) : text_(nlohmann::json::parse(json::to_text(schema))) {
        valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
        parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(text_), schema_);
    }

    bool accepts(const json::Value& document) const {
        // Written by us, so that 1e2 is 100: valijson goes by how a number is written, JSON Schema by its value.
        const auto value = nlohmann::json::parse(json::to_text(document));
        valijson::Validator validator;
        return validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(value), nullptr);
    }

  private:
    nlohmann::json text_;
    valijson::Schema schema_;
};

} // namespace sinew
