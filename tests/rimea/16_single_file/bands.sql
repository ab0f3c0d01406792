-- RiMEA test 16: reported next to the line measured by Seyfried et al. (2005): a person at v m/s needs
-- 0.36 m + 1.06 s v; the free speed is the upper bound.
WITH point AS (
  SELECT speed.model, density.value AS density, speed.value AS speed,
         max(0, min(1.34, (1 / density.value - 0.36) / 1.06)) AS seyfried
  FROM measured AS speed JOIN measured AS density USING (model, scenario, repetition)
  WHERE speed.metric = 'walking_speed' AND density.metric = 'density')
SELECT model, printf('speed at %.4g people/m, m/s (measured: %.3g)', density, seyfried), speed, NULL, NULL, 0
FROM point ORDER BY model DESC, density;
