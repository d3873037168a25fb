# Two leaves, one half above the other, over soil, under sun and sky: the light that each absorbs.
#   Rscript leaves.R FOLDER      where quasimc_r.so is, made by R CMD SHLIB of quasimc_r.c

folder <- commandArgs(trailingOnly = TRUE)[1]
dyn.load(file.path(folder, "quasimc_r.so"))

scene <- .Call("r_new_scene", '
bands = ["PAR"]
material = [{ name = "leaf", reflectance = 0.10, transmittance = 0.05 },
            { name = "soil", reflectance = 0.15 }]
ground = { material = "soil" }
source = [{ type = "sun", azimuth_deg = 135, elevation_deg = 50, irradiance_facing = 400 },
          { type = "sky", model = "uniform", irradiance_horizontal = 100 }]
run = { paths = 4096 }
')

# Each column a corner; each column a triangle, whose corners are counted from 0.
corners <- cbind(c(0, 0, 0.2), c(0.1, 0, 0.2), c(0.1, 0.1, 0.2), c(0, 0.1, 0.2),
                 c(0.05, 0, 0.3), c(0.15, 0, 0.3), c(0.15, 0.1, 0.3), c(0.05, 0.1, 0.3))
triangles <- cbind(c(0L, 1L, 2L), c(0L, 2L, 3L), c(4L, 5L, 6L), c(4L, 6L, 7L))
invisible(.Call("r_add_mesh", scene, corners, triangles, c(1L, 1L, 2L, 2L), "leaf"))
invisible(.Call("r_set_name", scene, 1L, "lower leaf"))
invisible(.Call("r_set_name", scene, 2L, "upper leaf"))

result <- .Call("r_run", scene)
mean <- .Call("r_get", result, "absorbed_flux", "PAR", "mean")
error <- .Call("r_get", result, "absorbed_flux", "PAR", "standard_error")
cat(sprintf("%s: %.3f W, standard error %.3f\n", .Call("r_organ_names", result), mean, error),
    sep = "")
