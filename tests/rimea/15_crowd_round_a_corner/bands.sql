-- RiMEA test 15: the time round the corner lies between those of the ways along its inside and 20 m off it.
WITH time AS (SELECT model, scenario, repetition, value FROM measured WHERE metric = 'evacuation_time')
SELECT corner.model, 'everybody round the corner after, s', corner.value, short.value, long.value, 0
FROM time AS corner JOIN time AS short USING (model, repetition) JOIN time AS long USING (model, repetition)
WHERE corner.scenario = 'corner' AND short.scenario = 'straight_short' AND long.scenario = 'straight_long'
ORDER BY corner.model DESC;
