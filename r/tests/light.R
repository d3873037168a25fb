# Tests of the package: each line stops with an error if it is not true.
library(quasimc)

leaf <- rbind(c(0, 0, 1), c(0.1, 0, 1), c(0, 0.1, 1))
face <- rbind(c(1, 2, 3))

scene <- quasimc_scene(c(PAR = "umol m-2 s-1", NIR = "W m-2"), title = "a \"leaf\"\\\n")
add(scene, "material", name = "black", reflectance = c(0, 0))
set(scene, "ground", material = "black")
add(scene, "source", type = "sky", model = "uniform", irradiance_horizontal = c(400, 300))
add_mesh(scene, leaf, face, material = "black", organ = 1, names = c("1" = "top"), labels = list(plant = c("1" = 7)))
result <- light(scene, paths = 256, groups = "plant")

# A black leaf above all else absorbs all light on its two sides; the lower one sees black soil.
organs <- as.data.frame(result, labels = "plant")
stopifnot(
    identical(organs$name, c("top", "ground")),
    organs$id[1] == 1,
    all.equal(organs$area[1], 0.005),
    identical(organs$plant, c(7L, NA)),
    all.equal(organs$absorbed_flux_PAR[1], 400 * 0.005, tolerance = 1e-6),
    all.equal(organs$absorbed_flux_NIR[1], 300 * 0.005, tolerance = 1e-6),
    all(organs$absorbed_flux_PAR_se >= 0),
    ncol(organs) == 4 + 2 * 2 * (length(grep("_PAR$", names(organs)))))

total <- totals(result)
stopifnot(
    identical(total$band, c("PAR", "NIR")),
    identical(total$unit_of_band, c("umol m-2 s-1", "W m-2")),
    all.equal(total$mean[1], organs$absorbed_flux_PAR[1]),
    total$ci95_low <= total$mean, total$mean <= total$ci95_high)

of_groups <- groups(result, quantities = "absorbed_flux")
stopifnot(
    identical(of_groups$by, c("all", "plant")),
    all.equal(of_groups$absorbed_flux_PAR, rep(total$mean[1], 2)))

light_of <- budget(result)
item <- function(name) light_of$mean[light_of$item == name & light_of$band == "PAR"]
stopifnot(all.equal(
    item("emitted"), item("absorbed_by_organs") + item("absorbed_by_ground") + item("escaped") + item("cut_off")))

info <- run_info(result)
stopifnot(info$paths == 256, info$stop == "finished", nchar(info$reason) > 0)

# A sensor above all else receives the sky; below the leaf less; a sphere has no sides.
add_sensors(scene, rbind(c(0, 0, 2), c(0.03, 0.03, 0.99)), name = "points")
add_sensors(scene, c(0, 0, 2), name = "ball", receiver = "sphere")
add(scene, "sensors", name = "bench", labels = list(kind = "grid"),
    at = list(start = c(0, 0, 1.5), along = c(1, 0, 0), across = c(0, 1, 0), counts = c(2, 3)))
measured <- light(scene, paths = 4096, origins = "sky")
at <- sensors(measured, labels = "kind")
stopifnot(
    identical(at$sensors, rep(c("points", "ball", "bench"), c(2, 1, 6))),
    identical(at$name[1:3], c("points 1", "points 2", "ball 1")),
    identical(at$kind, rep(c(NA, "grid"), c(3, 6))),
    all.equal(unlist(at[5, c("x", "y", "z")], use.names = FALSE), c(0.75, 1 / 6, 1.5)),
    abs(at$incident_upper_PAR[1] - 400) < 5 * at$incident_upper_PAR_se[1],
    at$incident_upper_PAR_se[1] < 8,
    at$incident_upper_PAR[2] < 100,
    all.equal(at$transmittance_PAR, at$incident_upper_PAR / 400),
    all.equal(at$transmittance_NIR_se, at$incident_upper_NIR_se / 300),
    identical(is.nan(at$transmittance_PAR), at$sensors == "ball"),
    identical(is.na(at$fluence_rate_NIR), at$sensors != "ball"),
    identical(is.na(at$incident_upper_NIR), at$sensors == "ball"),
    abs(at$fluence_rate_PAR[3] - 800) < 5 * at$fluence_rate_PAR_se[3],
    all.equal(sensors(measured, "incident_direct_from_sky")$incident_direct_from_sky_PAR, at$incident_direct_PAR),
    identical(dim(sensors(result)), c(0L, 5L + 2L * 2L * 6L)))

message_of <- function(expression) tryCatch({ expression; "" }, error = conditionMessage)
stopifnot(
    grepl("pathes", message_of(light(scene, pathes = 1))),
    grepl("three columns", message_of(add_mesh(scene, leaf[, 1:2], face, material = "black"))),
    grepl("give organ", message_of(add_mesh(scene, leaf, face, material = "black", names = c("1" = "top")))),
    grepl("there are 1 faces", message_of(add_mesh(scene, leaf, face, material = "black", organ = c(1, 2)))),
    grepl("three columns", message_of(add_sensors(scene, c(0, 1)))),
    grepl("key", message_of(add(scene, "material", "black"))),
    grepl("missing", message_of(set(scene, "ground", height = NA))))
