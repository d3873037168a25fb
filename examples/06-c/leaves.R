# Two leaves, one half above the other, over soil, under sun and sky: the light that each absorbs.
# The package quasimc is installed from the folder r/ (docs/guide/libraries.md).
library(quasimc)

scene <- quasimc_scene("PAR")
add(scene, "material", name = "leaf", reflectance = 0.10, transmittance = 0.05)
add(scene, "material", name = "soil", reflectance = 0.15)
set(scene, "ground", material = "soil")
add(scene, "source", type = "sun", azimuth_deg = 135, elevation_deg = 50, irradiance_facing = 400)
add(scene, "source", type = "sky", model = "uniform", irradiance_horizontal = 100)

# Each row a corner; each row a triangle, with the numbers of its corners.
corners <- rbind(c(0, 0, 0.2), c(0.1, 0, 0.2), c(0.1, 0.1, 0.2), c(0, 0.1, 0.2),
                 c(0.05, 0, 0.3), c(0.15, 0, 0.3), c(0.15, 0.1, 0.3), c(0.05, 0.1, 0.3))
triangles <- rbind(c(1, 2, 3), c(1, 3, 4), c(5, 6, 7), c(5, 7, 8))
add_mesh(scene, corners, triangles, material = "leaf", organ = c(1, 1, 2, 2),
         names = c("1" = "lower leaf", "2" = "upper leaf"))

result <- light(scene, paths = 4096)
organs <- as.data.frame(result, quantities = "absorbed_flux")
cat(sprintf("%s: %.3f W, standard error %.3f\n", organs$name, organs$absorbed_flux_PAR,
            organs$absorbed_flux_PAR_se), sep = "")
