// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/transfer/transfer_parameters.h>

#include <map>

namespace scree
{
  using namespace dealii;

  void TransferParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Transfer");
    prm.add_parameter("Method",
                      method,
                      "How velocity travels between points and nodes: FLIP, PIC, APIC or TPIC.",
                      Patterns::Selection("FLIP|PIC|APIC|TPIC"));
    prm.add_parameter("PIC rate",
                      pic_rate,
                      "Rate at which FLIP forgets the points' own velocity, 1/s: per step it keeps exp(-rate dt).",
                      Patterns::Double(0));
    prm.leave_subsection();
  }


  void TransferParameters::check() const
  {
    require_entry(transfer_method() == TransferMethod::flip || pic_rate == TransferParameters().pic_rate,
                  "Transfer",
                  "PIC rate",
                  pic_rate,
                  "nothing reads it, as \"Method = " + method +
                      "\" has no such rate. Remove it, or write \"Method = FLIP\".");
  }


  TransferMethod TransferParameters::transfer_method() const
  {
    static const std::map<std::string, TransferMethod> table{ { "FLIP", TransferMethod::flip },
                                                              { "PIC", TransferMethod::pic },
                                                              { "APIC", TransferMethod::apic },
                                                              { "TPIC", TransferMethod::tpic } };
    return table.at(method);
  }


  bool TransferParameters::carries_affine_field() const
  {
    return transfer_method() == TransferMethod::apic || transfer_method() == TransferMethod::tpic;
  }


  void StabilisationParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Stabilisation");
    prm.add_parameter(
        "F-bar",
        f_bar,
        "none; standard: the cell's mean volume change drives the material; modified: and the stored elastic "
        "volume strain of its points is averaged, and their volume follows the mean.",
        Patterns::Selection("none|standard|modified"));
    prm.leave_subsection();
  }


  FBar StabilisationParameters::f_bar_kind() const
  {
    static const std::map<std::string, FBar> table{ { "none", FBar::none },
                                                    { "standard", FBar::standard },
                                                    { "modified", FBar::modified } };
    return table.at(f_bar);
  }
} // namespace scree
