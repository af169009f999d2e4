// Templates.
#include "swage/template.h"

#include "cpu_steps.h"
#include "fuzz.h"
#include "same_tape.h"

namespace swage::fuzz {

void use(std::string_view bytes) {
  const auto read = unless_refused<UnreadableFile>([&] { return read_template(file_of(".json", bytes)); });
  if (!read) return;
  const Template again = parse_template(read->text(), "again");
  require(again.text() == read->text(), "a template is written as it was");
  require(same_tape(again.tape(), read->tape()), "and means the same");
  FieldValues field;
  Positions points(3, 3);
  points << 0, 0, 0, 0.5, -0.25, 0.125, 3, 4, 5;
  cpu_field(read->tape())->evaluate(points, read->defaults(), FieldDerivatives::all, field);
  require(field.values.size() == 3 && field.by_parameters.cols() == read->tape().parameter_count, "it has a field");
}

}  // namespace swage::fuzz
