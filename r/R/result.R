# Results as data frames. Every number has its standard error beside it: a column with _se.

kStatistics <- c("mean", "standard_error", "ci95_low", "ci95_high")

# A row for each organ, the ground last: id, name, labels, area, and for each quantity and band a
# column of values and one of standard errors: absorbed_flux_PAR, absorbed_flux_PAR_se.
# quantities: NULL: all; labels: keys of labels to add.
as.data.frame.quasimc_result <- function(x, row.names = NULL, optional = FALSE, ...,
                                         quantities = NULL, labels = character()) {
    table <- data.frame(
        id = .Call(C_organ_ids, x$handle), name = .Call(C_organ_names, x$handle),
        area = .Call(C_organ_areas, x$handle), row.names = row.names)
    for (key in labels) {
        table[[key]] <- utils::type.convert(.Call(C_organ_labels, x$handle, key), as.is = TRUE)
    }
    with_quantities(table, x, quantities, function(...) .Call(C_get_organs, ...))
}

# A row for each group: all organs, then the values of the option groups.
groups <- function(result, quantities = NULL) {
    table <- data.frame(by = .Call(C_group_by, result$handle), value = .Call(C_group_values, result$handle))
    with_quantities(table, result, quantities, function(...) .Call(C_get_groups, ...))
}

# A row for each sensor: set, name, x, y, z, and for each quantity and band a column of values and one
# of standard errors: incident_upper_PAR, incident_upper_PAR_se. Flat sensors have no fluence_rate,
# spheres no sides: NA. transmittance is the light from above over that on the horizontal above the
# canopy; NaN of sensors that do not face up, and where no light comes in or that light is unknown.
# quantities: NULL: all; labels: keys of labels to add.
sensors <- function(result, quantities = NULL, labels = character()) {
    sets <- .Call(C_set_names, result$handle)
    positions <- .Call(C_sensor_positions, result$handle)
    table <- data.frame(
        sensors = .Call(C_sensor_labels, result$handle, "sensors"),
        name = .Call(C_sensor_names, result$handle),
        x = positions[, 1], y = positions[, 2], z = positions[, 3])
    for (key in labels) {
        table[[key]] <- utils::type.convert(.Call(C_sensor_labels, result$handle, key), as.is = TRUE)
    }
    if (is.null(quantities)) {
        quantities <- c("incident_upper", "incident_lower", "incident_direct", "incident_scattered",
                        "fluence_rate", "transmittance")
    }
    with_quantities(table, result, quantities, function(handle, ...) {
        as.numeric(unlist(lapply(sets, function(set) of_sensor_set(handle, set, ...))))
    })
}

# NA for a quantity that sensors of this kind do not have.
of_sensor_set <- function(handle, set, quantity, ...) {
    is_sphere <- .Call(C_set_receiver, handle, set) == "sphere"
    is_absent <- if (is_sphere) grepl("^incident_(upper|lower)", quantity) else grepl("^fluence_rate", quantity)
    if (is_absent) rep(NA_real_, .Call(C_set_size, handle, set)) else .Call(C_get_sensor_set, handle, set, quantity, ...)
}

# A row for each band: the sum of a quantity over all organs but the ground, or its mean per area.
totals <- function(result, quantity = "absorbed_flux") {
    by_band(result, quantity, C_get_total)
}

# A row for each item and band of the energy budget.
budget <- function(result) {
    items <- c("emitted", "absorbed_by_organs", "absorbed_by_ground", "escaped", "cut_off", "imbalance")
    do.call(rbind, lapply(items, function(item) cbind(item = item, by_band(result, item, C_get_budget))))
}

# Method, paths and times of a run.
run_info <- function(result) {
    texts <- c("method", "reason", "stop")
    numbers <- c("paths", "replicates", "rays", "fraction_at_target", "preparation_seconds",
                 "solve_seconds", "solve_cpu_seconds")
    c(sapply(texts, function(key) .Call(C_run_text, result$handle, key), simplify = FALSE),
      sapply(numbers, function(key) .Call(C_run_number, result$handle, key), simplify = FALSE))
}

print.quasimc_result <- function(x, ...) {
    info <- run_info(x)
    cat("<result of QuasiMC: ", info$method, ", ", format(info$paths), " paths x ", info$replicates, ">\n", sep = "")
    print(utils::head(as.data.frame(x, quantities = "absorbed_flux")), ...)
    invisible(x)
}

by_band <- function(result, name, routine) {
    bands <- .Call(C_band_names, result$handle)
    values <- lapply(bands, function(band) .Call(routine, result$handle, name, band))
    table <- as.data.frame(do.call(rbind, values))
    names(table) <- kStatistics
    cbind(band = bands, table, unit_of_band = .Call(C_band_units, result$handle))
}

with_quantities <- function(table, result, quantities, routine) {
    bands <- .Call(C_band_names, result$handle)
    if (is.null(quantities)) {
        quantities <- .Call(C_quantity_names)
    }
    for (quantity in quantities) {
        for (band in bands) {
            column <- paste0(quantity, "_", band)
            table[[column]] <- routine(result$handle, quantity, band, "mean")
            table[[paste0(column, "_se")]] <- routine(result$handle, quantity, band, "standard_error")
        }
    }
    table
}
