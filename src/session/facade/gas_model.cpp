#include "ifov/gas_model.h"

#include "core/call_scope.h"
#include "core/error.h"
#include "core/format.h"
#include "session/surveys/gas_model_fit.h"

namespace ifov {

GasModelOutcome make_gas_model(const GasModelQuestion& question, const std::filesystem::path& to) {
  if (question.threads < 0)
    throw InputError(format("threads: {} was asked for; 0 takes all cores", question.threads));
  const Call call{current_call().inputs, question.cancel};
  const CallScope scope(call);
  return session::make_gas_model(question, to);
}

}  // namespace ifov
