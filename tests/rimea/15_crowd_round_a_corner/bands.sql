-- RiMEA test 15: the time around the corner is between those of a way along its inside and of one 20 m from it.
WITH time AS (SELECT model, scenario, repetition, value FROM measured WHERE metric = 'evacuation_time')
SELECT corner.model, 'everybody round the corner after, s', corner.value, short.value, long.value, 0
FROM time AS corner JOIN time AS short USING (model, repetition) JOIN time AS long USING (model, repetition)
WHERE corner.scenario = 'corner' AND short.scenario = 'straight_short' AND long.scenario = 'straight_long'
ORDER BY corner.model DESC;
