// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scree/input/input_error.h>
#include <scree/transfer/transfer_parameters.h>

#include <cmath>
#include <map>

namespace scree
{
  using namespace dealii;

  void TransferParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Transfer");
    prm.add_parameter("Method",
                      method,
                      "Transfer of velocity between points and nodes: FLIP, TPIC or AFLIP.",
                      Patterns::Selection("FLIP|TPIC|AFLIP"));
    prm.add_parameter(
        "PIC rate",
        rate,
        "1/s; rate at which the point velocity relaxes to the grid velocity (FLIP and AFLIP). The part exp(-rate dt) "
        "remains per time step. auto: 1 1/s for FLIP; 5 sqrt(g/h) for AFLIP, without gravity c/h.",
        Patterns::Anything());
    prm.leave_subsection();
  }


  void TransferParameters::check() const
  {
    if (rate == "auto")
      return;
    const double number = number_of(rate);
    require_entry(std::isfinite(number) && number >= 0,
                  { "Transfer", "PIC rate", rate },
                  "write auto, or a number from 0 on, in 1/s.");
    require_entry(keeps_velocity(transfer_method()),
                  { "Transfer", "PIC rate", rate },
                  "this entry has no effect, as \"Method = " + method +
                      "\" has no such rate. Remove it, or write \"Method = FLIP\" or \"Method = AFLIP\".");
  }


  void TransferParameters::choose_rate(const double gravity, const double wave_speed, const double cell_size)
  {
    if (rate != "auto")
      pic_rate = number_of(rate);
    else if (transfer_method() == TransferMethod::aflip)
      pic_rate = gravity > 0 ? 5 * std::sqrt(gravity / cell_size) : wave_speed / cell_size;
    else
      pic_rate = 1;
  }


  std::string TransferParameters::text() const
  {
    if (!keeps_velocity(transfer_method()))
      return method;
    return method + " (PIC rate " + (rate == "auto" ? "auto: " : "") + number_text(pic_rate) + " 1/s)";
  }


  TransferMethod TransferParameters::transfer_method() const
  {
    static const std::map<std::string, TransferMethod> table{ { "FLIP", TransferMethod::flip },
                                                              { "TPIC", TransferMethod::tpic },
                                                              { "AFLIP", TransferMethod::aflip } };
    return table.at(method);
  }


  bool TransferParameters::carries_affine_field() const
  {
    return carries_affine(transfer_method());
  }


  void StabilisationParameters::add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Stabilisation");
    prm.add_parameter("F-bar",
                      f_bar,
                      "Averaging of the volume change over points. projected: linear functions of the cells' vertices, "
                      "the space of the pore pressure, carry it, and the elastic volume strain relaxes to them as far "
                      "as the soil shears. For comparison: none, each point uses its own; standard, the mean of the "
                      "cell determines the stress; modified, the elastic volume strain and the volume of the points "
                      "follow the mean of the cell, too.",
                      Patterns::Selection("projected|none|standard|modified"));
    prm.add_parameter("Skeleton damping",
                      skeleton_damping,
                      "Kelvin-Voigt damping of the elastic skeleton of soil in water, where ground or walls with "
                      "friction are: its time x over cell size per wave speed, against flutter of the effective stress "
                      "that makes stiff undrained layers stick. 0.5 serves layers of up to six cells; x of "
                      "thickness/(12 h) serves thicker ones. The Courant number is then at most sqrt(1 + x^2) - x. "
                      "0: none.",
                      Patterns::Double(0, 10));
    prm.leave_subsection();
  }


  FBar StabilisationParameters::f_bar_kind() const
  {
    static const std::map<std::string, FBar> table{ { "none", FBar::none },
                                                    { "standard", FBar::standard },
                                                    { "modified", FBar::modified },
                                                    { "projected", FBar::projected } };
    return table.at(f_bar);
  }
} // namespace scree
