-- Counter-flow: people walk at seven tenths of their desired speeds at least, in lanes. Both bands are ours: that of the
-- speed was set before the first run, that of the lane order (0: none, 1: full) after it. ORCA's lane order is reported.
SELECT model, 'speed over the desired one, least', min(value), 0.7, NULL, model <> 'ORCA'
FROM measured WHERE metric = 'relative_speed' GROUP BY model ORDER BY model DESC;
SELECT model, 'lane order, mean', avg(value), 0.3, NULL, model <> 'ORCA'
FROM measured WHERE metric = 'lane_order' GROUP BY model ORDER BY model DESC;
