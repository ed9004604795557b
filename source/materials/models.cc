#include <impoint/base/parameter_file.h>
#include <impoint/materials/drucker_prager.h>
#include <impoint/materials/elastoplastic.h>
#include <impoint/materials/hencky.h>
#include <impoint/materials/linear_elastic.h>
#include <impoint/materials/models.h>
#include <impoint/materials/mohr_coulomb.h>
#include <impoint/materials/neo_hookean.h>
#include <impoint/materials/st_venant_kirchhoff.h>
#include <impoint/materials/von_mises.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace Impoint
{
  namespace Materials
  {
    namespace
    {
      double number(const ParameterFile &file, const std::string &path)
      {
        return Utilities::string_to_double(file.value(path));
      }



      void check_angles(const ParameterFile &file, const std::string &section)
      {
        const std::string dilation = section + "/Dilation angle";
        if (number(file, dilation) > number(file, section + "/Friction angle"))
          throw file.error(dilation,
                           "the dilation angle is " + file.value(dilation) +
                             ", above the friction angle: flow would create "
                             "energy",
                           "Set it from 0 to 'Friction angle'.");
        if (number(file, section + "/Friction angle") == 0 &&
            number(file, section + "/Cohesion") == 0)
          throw file.error(section + "/Friction angle",
                           "the material has neither friction nor cohesion",
                           "Set 'Friction angle' [degrees] or 'Cohesion' [Pa] "
                           "above 0.");
      }



      Softening softening(const ParameterFile &file, const std::string &section)
      {
        Softening result;
        result.residual = number(file, section + "/Softening residual");
        result.strain   = number(file, section + "/Softening strain");
        if (result.residual < 1 && !(result.strain > 0))
          throw file.error(section + "/Softening strain",
                           "strength falls without a strain to fall over",
                           "Set the plastic strain, e.g. 0.1, or 'Softening "
                           "residual = 1'.");
        if (result.residual == 1 && file.is_set(section + "/Softening strain"))
          throw file.error(section + "/Softening strain",
                           "'Softening strain' is set, but nothing softens",
                           "Set 'Softening residual' below 1, or take the "
                           "entry away.");
        return result;
      }



      using Surface = std::unique_ptr<const YieldSurface>;

      /** Of a surface with cohesion, friction and dilation. */
      template <typename Cone>
      Surface make_cone(const ElasticModuli &moduli,
                        const ParameterFile &file,
                        const std::string   &section)
      {
        check_angles(file, section);
        return std::make_unique<Cone>(moduli,
                                      number(file, section + "/Cohesion"),
                                      number(file, section + "/Friction angle"),
                                      number(file,
                                             section + "/Dilation angle"));
      }



      Surface make_von_mises(const ElasticModuli &moduli,
                             const ParameterFile &file,
                             const std::string   &section)
      {
        const std::string path = section + "/Yield stress";
        if (!(number(file, path) > 0))
          throw file.error(path,
                           "the yield stress is " + file.value(path),
                           "Set it in Pa, above 0.");
        return std::make_unique<VonMises>(moduli, number(file, path));
      }



      template <typename Class, int dim>
      std::unique_ptr<Material<dim>> make_elastic(const ElasticModuli &moduli,
                                                  const ParameterFile &,
                                                  const std::string &)
      {
        return std::make_unique<Class>(moduli);
      }



      template <int dim,
                Surface (*make_surface)(const ElasticModuli &,
                                        const ParameterFile &,
                                        const std::string &)>
      std::unique_ptr<Material<dim>> make_plastic(const ElasticModuli &moduli,
                                                  const ParameterFile &file,
                                                  const std::string   &section)
      {
        return std::make_unique<Elastoplastic<dim>>(
          moduli,
          make_surface(moduli, file, section),
          softening(file, section),
          file.value(section + "/Close gaps") == "true");
      }



      /** The row of a law of E and nu alone. */
      template <template <int> class Class>
      Model elastic(const std::string &name, const std::string &help)
      {
        return {name,
                help,
                {},
                {make_elastic<Class<2>, 2>, make_elastic<Class<3>, 3>}};
      }



      /** The row of a yield surface. */
      template <Surface (*make_surface)(const ElasticModuli &,
                                        const ParameterFile &,
                                        const std::string &)>
      Model plastic(const std::string       &name,
                    const std::string       &help,
                    std::vector<std::string> entries)
      {
        entries.insert(entries.end(),
                       {"Softening residual", "Softening strain"});
        return {name,
                help,
                entries,
                {make_plastic<2, make_surface>, make_plastic<3, make_surface>}};
      }



      std::shared_ptr<const Patterns::PatternBase>
      from(const double least,
           const double most = Patterns::Double::max_double_value)
      {
        return std::make_shared<Patterns::Double>(least, most);
      }
    } // namespace



    const std::vector<Model> &models()
    {
      static const std::vector<std::string> of_cones = {"Cohesion",
                                                        "Friction angle",
                                                        "Dilation angle",
                                                        "Close gaps"};
      static const std::vector<Model>       table    = {
                 elastic<LinearElastic>("linear elastic",
                               "small strains, stress summed up over the "
                                        "steps; one iteration a step"),
                 elastic<StVenantKirchhoff>("St. Venant-Kirchhoff",
                                   "linear in Green's strain, moderate strains "
                                            "only"),
                 elastic<NeoHookean>("neo-Hookean", "mu (b - 1) + lambda ln J 1"),
                 elastic<Hencky>("Hencky", "linear in the logarithmic strain"),
                 plastic<make_cone<MohrCoulomb>>("Mohr-Coulomb",
                                        "Hencky's law, and plastic flow where "
                                                 "shear exceeds cohesion and friction",
                                        of_cones),
                 plastic<make_cone<DruckerPrager>>("Drucker-Prager",
                                          "the same, on a round cone",
                                          of_cones),
                 plastic<make_von_mises>("von Mises",
                                "Hencky's law, and plastic flow at a shear "
                                         "stress whatever the pressure",
                                {"Yield stress"})};
      return table;
    }



    const std::vector<ModelEntry> &model_entries()
    {
      static const std::vector<ModelEntry> table = {
        {"Cohesion", "0", from(0), "c [Pa]; may be 0."},
        {"Friction angle", "0", from(0, 89), "phi [degrees]."},
        {"Dilation angle",
         "0",
         from(0, 89),
         "psi [degrees], from 0 (flow keeps the volume) to the friction angle "
         "(associated flow)."},
        {"Yield stress", "0", from(0), "in uniaxial stress [Pa]."},
        {"Softening residual",
         "1",
         from(0, 1),
         "part r of cohesion or yield stress that is left after large plastic "
         "strains kappa; on the way it is r + (1 - r) exp(-kappa / softening "
         "strain), with kappa at the step's start."},
        {"Softening strain",
         "0",
         from(0),
         "equivalent plastic strain in which strength decays [-]."},
        {"Close gaps",
         "true",
         std::make_shared<Patterns::Bool>(),
         "what was torn open bears no pressure before it is closed again. "
         "'false', as in the papers: it does at once, and the volume of what "
         "flows grows with time."}};
      return table;
    }



    const Model &model(const std::string &name)
    {
      for (const Model &row : models())
        if (row.name == name)
          return row;
      AssertThrow(false, ExcMessage("No model is called '" + name + "'"));
      return models().front();
    }



    std::vector<std::string> ModelEntry::models() const
    {
      std::vector<std::string> names;
      for (const Model &row : Materials::models())
        if (std::count(row.entries.begin(), row.entries.end(), name) > 0)
          names.push_back(row.name);
      return names;
    }
  } // namespace Materials
} // namespace Impoint
